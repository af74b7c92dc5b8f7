// SPDX-License-Identifier: MIT
#include "apps/check.hpp"

#include "apps/calibrate.hpp"
#include "apps/expected_steps.hpp"
#include "apps/make_state.hpp"
#include "core/error.hpp"
#include "io/progress.hpp"
#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>

namespace arenite {
namespace {

void print(std::string const& line) { std::fputs((line + "\n").c_str(), stdout); }

/// given: grains that the scene names one by one. Returns how many there will be.
long long print_classes(Scene const& scene, long long given)
{
    if (scene.particles.source != ParticleSource::distribution) {
        print(fmt::format("grains: {}", given));
        return given;
    }
    DistributionSettings const& distribution = scene.particles.distribution;
    Region const region = distribution.region.value_or(Region{scene.domain.lower, scene.domain.upper});
    Vec3 const size = region.upper - region.lower;
    auto const classes = make_size_classes(distribution, scene.coarse_graining, size.x * size.y * size.z);
    long long total = 0;
    for (SizeClass const& c : classes) total += c.count;
    print(fmt::format("grains: {} in {} classes, k = {:g}, mean-volume diameter of the original grains {:.5g} m", total,
                      classes.size(), scene.coarse_graining.factor, mean_volume_diameter(distribution)));
    print("  class  original diameter (m)  grain diameter (m)  grains");
    for (std::size_t c = 0; c < classes.size(); ++c)
        print(fmt::format("  {:5}  {:21.6g}  {:18.6g}  {:6}", c, classes[c].original_diameter, classes[c].diameter,
                          classes[c].count));
    return total;
}

void print_time_steps(Scene const& scene, StagePlan const& plan)
{
    if (scene.particles.source == ParticleSource::none || plan.empty()) return;
    TimeStepLimits const& limits = plan.front().limits;
    print(fmt::format(
        "critical time steps, smallest grain {:.4g} m: Rayleigh {:.4g} s, lattice limit at {:.3g} Pa {:.4g} s, contact "
        "period {:.4g} s",
        limits.smallest_diameter, limits.rayleigh, limits.pressure, limits.lattice, limits.contact_period));
    if (scene.particles.source != ParticleSource::distribution) return;
    Real const mean = std::round(mean_volume_diameter(scene.particles.distribution) * 1e5) / 1e5; // the paper's two digits
    int const row = std::max(0, material_row(scene, scene.particles.material));
    print(fmt::format("  Rayleigh of the mean-volume grain {:.3g} m: {:.4g} s at k = 1, {:.4g} s at k = {:g}", mean,
                      rayleigh_time(scene.materials[row], mean / 2),
                      rayleigh_time(scene.materials[row], scene.coarse_graining.factor * mean / 2),
                      scene.coarse_graining.factor));
}

void print_fluid(Scene const& scene)
{
    if (!scene.fluid) return print("fluid: none");
    FluidSettings const& fluid = *scene.fluid;
    Region const box = fluid.box.value_or(Region{scene.domain.lower, scene.domain.upper});
    Vec3 const size = box.upper - box.lower;
    print(fmt::format("fluid: {} x {} x {} cells of {:.4g} x {:.4g} x {:.4g} m{}", fluid.cells[0], fluid.cells[1],
                      fluid.cells[2], size.x / fluid.cells[0], size.y / fluid.cells[1], size.z / fluid.cells[2],
                      fluid.fit_wall.empty() ? ""
                                             : " (the box ends at wall \"" + fluid.fit_wall + "\" when the stage begins)"));
    if (scene.particles.source != ParticleSource::distribution) return;
    DistributionSettings const& d = scene.particles.distribution;
    Real const k = scene.coarse_graining.factor,
               cell = std::min({size.x / fluid.cells[0], size.y / fluid.cells[1], size.z / fluid.cells[2]});
    Real const largest = k * d.diameters.back();
    print(fmt::format("  cell / diameter: {:.2f} of the mean-volume grain, {:.2f} of the largest; smoothing length {:.4g} m "
                      "is {:.2f} of the largest",
                      cell / (k * mean_volume_diameter(d)), cell / largest, fluid.smoothing_length,
                      fluid.smoothing_length / largest));
}

/// What the stages cost here; those that run the same kernels are measured once.
class Costs {
public:
    explicit Costs(Scene const& scene) : scene_(scene) {}

    StageCost const& of(PlannedStage const& stage)
    {
        auto const key =
            std::make_tuple(stage.settings.contact.normal, stage.settings.fluid, stage.settings.local_damping > 0);
        auto const found = known_.find(key);
        return found != known_.end() ? found->second : known_.emplace(key, measure_stage(scene_, stage)).first->second;
    }

    double memory() const
    {
        double most = 0;
        for (auto const& entry : known_) most = std::max(most, entry.second.memory);
        return most;
    }

private:
    Scene const& scene_;
    std::map<std::tuple<NormalLaw, bool, bool>, StageCost> known_;
};

std::string time_text(double seconds) { return seconds < 60 ? fmt::format("{:.1f} s", seconds) : duration_text(seconds); }

std::string describe(PlannedStage const& stage, ExpectedSteps const& steps, double seconds, double grain_seconds,
                     long long grains)
{
    std::string line = fmt::format("  {}: dt {:.4g} s, ", stage.label, stage.dt);
    if (steps.count > 0) line += fmt::format("{} {:.4g} steps", steps.is_bound ? "at most" : "about", steps.count);
    else line += "until its conditions hold";
    if (stage.coupling_interval > 0) line += fmt::format(", a fluid step every {} steps", stage.coupling_interval);
    line += fmt::format(": {}", steps.count > 0 ? time_text(seconds) : "nobody knows how long");
    if (grains > 0 && grain_seconds > 0)
        line += fmt::format(" ({:.3g} particle-steps/s)", static_cast<double>(grains) * steps.count / grain_seconds);
    return line;
}

void print_stages(Scene const& scene, StagePlan const& plan, long long grains)
{
    Costs costs(scene);
    print("stages:");
    double total = 0, fields = 0;
    bool is_bound = false;
    for (PlannedStage const& stage : plan) {
        if (stage.settings.kind == StageKind::generation) {
            print(fmt::format("  {}: grains are placed at random", stage.label));
            continue;
        }
        StageCost const& cost = costs.of(stage);
        ExpectedSteps const steps = expected_steps(stage);
        double const fluid_steps = stage.coupling_interval > 0 ? steps.count / stage.coupling_interval : 0;
        double const grain_seconds = steps.count * (cost.step + cost.search / expected_search_interval(stage));
        double const seconds = grain_seconds + fluid_steps * cost.fluid_step;
        total += seconds;
        is_bound = is_bound || steps.is_bound;
        Real const interval = stage.settings.field_interval.value_or(scene.output.field_interval);
        fields += interval > 0 ? steps.count * stage.dt / interval + 1 : 2;
        print(describe(stage, steps, seconds, grain_seconds, grains));
    }
    print(fmt::format("expected wall time: {}{} without output, as fast as the machine is now", is_bound ? "at most " : "",
                      time_text(total)));
    print(fmt::format("memory: {:.1f} MB", 1e-6 * costs.memory()));
    print(fmt::format("output: about {:.1f} MB of fields", 1e-6 * fields * static_cast<double>(grains) * 90));
}

} // namespace

int check_scene(std::string const& path, std::vector<std::string> const& overrides)
{
    Scene const scene = read_scene(path, overrides);
    StagePlan const plan = make_stage_plan(scene);
    long long const given = make_run_state(scene).particles.count; // walls and files are tried too
    print(scene.resolved);
    print("# ---- what would run");
    long long const grains = print_classes(scene, given);
    print_time_steps(scene, plan);
    print_fluid(scene);
    print_stages(scene, plan, grains);
    return 0;
}

} // namespace arenite
