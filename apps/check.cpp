// SPDX-License-Identifier: MIT
#include "apps/check.hpp"

#include "apps/calibrate.hpp"
#include "apps/expected_steps.hpp"
#include "apps/make_state.hpp"
#include "apps/run_checkpoint.hpp"
#include "core/error.hpp"
#include "io/progress.hpp"
#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <tuple>

namespace arenite {
namespace {

void print(std::string const& line) { std::fputs((line + "\n").c_str(), stdout); }

/// Of grains that the scene names one by one.
void print_given(std::vector<Grain> const& given)
{
    struct Sizes {
        Real least = std::numeric_limits<Real>::infinity(), largest = 0;
        long long count = 0;
    };
    std::map<int, Sizes> classes;
    for (Grain const& grain : given) {
        Sizes& sizes = classes[grain.size_class];
        sizes.least = std::min(sizes.least, grain.diameter);
        sizes.largest = std::max(sizes.largest, grain.diameter);
        ++sizes.count;
    }
    print(fmt::format("grains: {} in {} classes", given.size(), classes.size()));
    print("  class  smallest diameter (m)  largest diameter (m)  grains");
    for (auto const& [number, sizes] : classes)
        print(fmt::format("  {:5}  {:21.6g}  {:20.6g}  {:6}", number, sizes.least, sizes.largest, sizes.count));
}

/// given: grains that the scene names one by one. Returns how many there will be.
long long print_classes(Scene const& scene, std::vector<Grain> const& given)
{
    if (scene.particles.source == ParticleSource::none) print("grains: none");
    else if (scene.particles.source != ParticleSource::distribution) print_given(given);
    if (scene.particles.source != ParticleSource::distribution) return static_cast<long long>(given.size());
    DistributionSettings const& distribution = scene.particles.distribution;
    Region const region = generation_region(scene);
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
    print(fmt::format("critical time steps, smallest grain {:.4g} m: Rayleigh {:.4g} s{}", limits.smallest_diameter,
                      limits.rayleigh,
                      limits.lattice > 0 ? fmt::format(", lattice limit at {:.3g} Pa {:.4g} s, contact period {:.4g} s",
                                                       limits.pressure, limits.lattice, limits.contact_period)
                                         : ""));
    if (scene.particles.source != ParticleSource::distribution) return;
    Real const mean = std::round(mean_volume_diameter(scene.particles.distribution) * 1e5) / 1e5; // the paper's two digits
    int const row = std::max(0, material_row(scene, scene.particles.material));
    print(fmt::format("  Rayleigh of the mean-volume grain {:.3g} m: {:.4g} s at k = 1, {:.4g} s at k = {:g}", mean,
                      rayleigh_time(scene.materials[row], mean / 2),
                      rayleigh_time(scene.materials[row], scene.coarse_graining.factor * mean / 2),
                      scene.coarse_graining.factor));
}

void print_fluid(Scene const& scene, std::vector<Grain> const& given)
{
    if (!scene.fluid) return print("fluid: none");
    FluidSettings const& fluid = *scene.fluid;
    Region const box = fluid.box.value_or(Region{scene.domain.lower, scene.domain.upper});
    Vec3 const size = box.upper - box.lower;
    print(fmt::format("fluid: {} x {} x {} cells of {:.4g} x {:.4g} x {:.4g} m{}", fluid.cells[0], fluid.cells[1],
                      fluid.cells[2], size.x / fluid.cells[0], size.y / fluid.cells[1], size.z / fluid.cells[2],
                      fluid.fit_wall.empty() ? ""
                                             : " (the box ends at wall \"" + fluid.fit_wall + "\" when the stage begins)"));
    if (scene.particles.source == ParticleSource::none) return;
    DistributionSettings const& d = scene.particles.distribution;
    Real const k = scene.coarse_graining.factor,
               cell = std::min({size.x / fluid.cells[0], size.y / fluid.cells[1], size.z / fluid.cells[2]});
    Real largest = 0, mean = 0; // m; mean: of the volumes
    for (Grain const& grain : given) {
        largest = std::max(largest, grain.diameter);
        mean += grain.diameter * grain.diameter * grain.diameter / static_cast<Real>(given.size());
    }
    mean = std::cbrt(mean);
    if (scene.particles.source == ParticleSource::distribution) {
        largest = k * d.diameters.back();
        mean = k * mean_volume_diameter(d);
    }
    if (!(largest > 0)) return;
    print(fmt::format("  cell / diameter: {:.2f} of the mean-volume grain, {:.2f} of the largest; smoothing length {:.4g} m "
                      "is {:.2f} of the largest",
                      cell / mean, cell / largest, fluid.smoothing_length, fluid.smoothing_length / largest));
}

/// What the stages cost here; those that run the same kernels are measured once.
class Costs {
public:
    explicit Costs(Scene const& scene) : scene_(scene) {}

    StageCost const& of(PlannedStage const& stage)
    {
        StageSettings const& s = stage.settings;
        bool const moving = std::any_of(s.walls.begin(), s.walls.end(),
                                        [](WallAction const& a) { return a.velocity || a.angular_velocity || a.servo; });
        Key const key{s.contact.normal, s.wall_contact.normal, s.contact.tangential, s.fluid, s.local_damping > 0, moving};
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
    /// What the kernels depend on. A strain of box or carrier costs too little to be seen.
    using Key = std::tuple<NormalLaw, NormalLaw, TangentialLaw, bool, bool, bool>;

    Scene const& scene_;
    std::map<Key, StageCost> known_;
};

/// Bytes that a grain takes in particles files, compressed: 22 for a vector, 2 for a number (demo's sample: 147 in all).
double grain_bytes(std::vector<std::string> const& fields)
{
    double bytes = 24; // the position
    for (std::string const& field : fields) {
        bool const vector =
            field == "velocity" || field == "spin" || field == "force" || field == "torque" || field == "fluid_force";
        bytes += vector ? 22 : 2;
    }
    return bytes;
}

double cell_bytes(std::vector<std::string> const& fields)
{
    double bytes = 0;
    for (std::string const& field : fields) bytes += field == "velocity" ? 22 : 7;
    return bytes;
}

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
    double total = 0, fields = 0, checkpoints = 0; // bytes of the two
    bool is_bound = false;
    double const cells = scene.fluid ? Real(scene.fluid->cells[0]) * scene.fluid->cells[1] * scene.fluid->cells[2] : 0;
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
        double const times = interval > 0 ? steps.count * stage.dt / interval + 1 : 2;
        double const wet = stage.settings.fluid ? cells : 0;
        fields += times * (static_cast<double>(grains) * grain_bytes(scene.output.grain_fields) +
                           wet * cell_bytes(scene.output.fluid_fields));
        checkpoints += checkpoint_bytes(static_cast<double>(grains), wet);
        print(describe(stage, steps, seconds, grain_seconds, grains));
    }
    print(fmt::format("expected wall time: {}{} without output, as fast as the machine is now", is_bound ? "at most " : "",
                      time_text(total)));
    print(fmt::format("memory: {:.1f} MB", 1e-6 * costs.memory()));
    if (can_write_checkpoints()) // beside one at each stage's end two stay
        checkpoints += 2 * checkpoint_bytes(static_cast<double>(grains), cells);
    print(fmt::format("output: about {:.1f} MB of fields and {:.1f} MB of checkpoints", 1e-6 * fields,
                      can_write_checkpoints() ? 1e-6 * checkpoints : 0));
}

} // namespace

int check_scene(std::string const& path, std::vector<std::string> const& overrides)
{
    Scene const scene = read_scene(path, overrides);
    StagePlan const plan = make_stage_plan(scene);
    std::vector<Grain> const given = download(make_run_state(scene).particles); // walls and files are tried too
    print(scene.resolved);
    print("# ---- what would run");
    long long const grains = print_classes(scene, given);
    print_time_steps(scene, plan);
    print_fluid(scene, given);
    print_stages(scene, plan, grains);
    return 0;
}

} // namespace arenite
