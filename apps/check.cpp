// SPDX-License-Identifier: MIT
#include "apps/check.hpp"

#include "apps/calibrate.hpp"
#include "apps/given_grains.hpp"
#include "apps/make_state.hpp"
#include "core/error.hpp"
#include "io/progress.hpp"
#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace arenite {
namespace {

void print(std::string const& line) { std::fputs((line + "\n").c_str(), stdout); }

long long print_classes(Scene const& scene)
{
    if (scene.particles.source != ParticleSource::distribution) {
        long long const count = has_given_grains(scene) ? static_cast<long long>(given_grains(scene).size()) : 0;
        print(fmt::format("grains: {}", count));
        return count;
    }
    DistributionSettings const& distribution = scene.particles.distribution;
    Region const region = distribution.region.value_or(Region{scene.domain.lower, scene.domain.upper});
    Vec3 const size = region.upper - region.lower;
    auto const classes = make_size_classes(distribution, scene.coarse_graining, size.x * size.y * size.z);
    long long total = 0;
    for (SizeClass const& c : classes) total += c.count;
    print(fmt::format("grains: {} in {} classes, k = {:g}, mean-volume diameter of the original grains {:.5g} m", total, classes.size(),
                      scene.coarse_graining.factor, mean_volume_diameter(distribution)));
    print("  class  original diameter (m)  grain diameter (m)  grains");
    for (std::size_t c = 0; c < classes.size(); ++c)
        print(fmt::format("  {:5}  {:21.6g}  {:18.6g}  {:6}", c, classes[c].original_diameter, classes[c].diameter, classes[c].count));
    return total;
}

void print_time_steps(Scene const& scene, StagePlan const& plan)
{
    if (scene.particles.source == ParticleSource::none || plan.empty()) return;
    TimeStepLimits const& limits = plan.front().limits;
    print(fmt::format("critical time steps, smallest grain {:.4g} m: Rayleigh {:.4g} s, lattice limit at {:.3g} Pa {:.4g} s, contact "
                      "period {:.4g} s",
                      limits.smallest_diameter, limits.rayleigh, limits.pressure, limits.lattice, limits.contact_period));
    if (scene.particles.source != ParticleSource::distribution) return;
    Real const mean = std::round(mean_volume_diameter(scene.particles.distribution) * 1e5) / 1e5; // the paper's two digits
    int const row = std::max(0, material_row(scene, scene.particles.material));
    print(fmt::format("  Rayleigh of the mean-volume grain {:.3g} m: {:.4g} s at k = 1, {:.4g} s at k = {:g}", mean,
                      rayleigh_time(scene.materials[row], mean / 2), rayleigh_time(scene.materials[row], scene.coarse_graining.factor * mean / 2),
                      scene.coarse_graining.factor));
}

void print_fluid(Scene const& scene)
{
    if (!scene.fluid) return print("fluid: none");
    FluidSettings const& fluid = *scene.fluid;
    Region const box = fluid.box.value_or(Region{scene.domain.lower, scene.domain.upper});
    Vec3 const size = box.upper - box.lower;
    print(fmt::format("fluid: {} x {} x {} cells of {:.4g} x {:.4g} x {:.4g} m{}", fluid.cells[0], fluid.cells[1], fluid.cells[2],
                      size.x / fluid.cells[0], size.y / fluid.cells[1], size.z / fluid.cells[2],
                      fluid.fit_wall.empty() ? "" : " (the box ends at wall \"" + fluid.fit_wall + "\" when the stage begins)"));
    if (scene.particles.source != ParticleSource::distribution) return;
    DistributionSettings const& d = scene.particles.distribution;
    Real const k = scene.coarse_graining.factor, cell = std::min({size.x / fluid.cells[0], size.y / fluid.cells[1], size.z / fluid.cells[2]});
    Real const largest = k * d.diameters.back();
    print(fmt::format("  cell / diameter: {:.2f} of the mean-volume grain, {:.2f} of the largest; smoothing length {:.4g} m is {:.2f} of the largest",
                      cell / (k * mean_volume_diameter(d)), cell / largest, fluid.smoothing_length, fluid.smoothing_length / largest));
}

/// Bytes per grain of state and contact lists at five contacts and seven candidates a grain; see docs/performance.
constexpr double bytes_per_grain = 32 * 5 + 8 + 1 + 2 + 1 + 32 + 3.6 * (8 + 32 + 1 + 1 + 32 + 64 + 8) + 2 * 4;

double steps_of(PlannedStage const& stage)
{
    return stage.settings.duration > 0 && stage.dt > 0 ? std::ceil(stage.settings.duration / stage.dt) : 0;
}

void print_stages(Scene const& scene, StagePlan const& plan, long long grains)
{
    Calibration const speed = calibrate();
    print("stages:");
    double total = 0, fields = 0;
    for (PlannedStage const& stage : plan) {
        if (stage.settings.kind == StageKind::generation) {
            print(fmt::format("  {}: grains are placed at random", stage.label));
            continue;
        }
        double const steps = steps_of(stage), rate = speed.particle_steps_per_second(stage);
        double const fluid_steps = stage.coupling_interval > 0 ? steps / stage.coupling_interval : 0;
        double const seconds = steps * static_cast<double>(std::max(1ll, grains)) / rate +
                               (scene.fluid ? fluid_steps * scene.fluid->cells[0] * scene.fluid->cells[1] * scene.fluid->cells[2] / speed.fluid_cells_per_second : 0);
        total += seconds;
        Real const interval = stage.settings.field_interval.value_or(scene.output.field_interval);
        fields += interval > 0 && stage.settings.duration > 0 ? stage.settings.duration / interval + 1 : 2;
        print(fmt::format("  {}: dt {:.4g} s{}{}, about {} ({:.3g} particle-steps/s)", stage.label, stage.dt,
                          steps > 0 ? fmt::format(", {} {:.4g} steps", stage.settings.end.any() ? "at most" : "", steps) : ", until its conditions hold",
                          fluid_steps > 0 ? fmt::format(", a fluid step every {} steps", stage.coupling_interval) : "", duration_text(seconds), rate));
    }
    print(fmt::format("expected wall time: {} in all (at most, where a stage may end early)", duration_text(total)));
    print(fmt::format("memory: about {:.1f} MB of grains and contacts", 1e-6 * bytes_per_grain * static_cast<double>(grains)));
    print(fmt::format("output: about {:.1f} MB of fields", 1e-6 * fields * static_cast<double>(grains) * 90));
}

} // namespace

int check_scene(std::string const& path, std::vector<std::string> const& overrides)
{
    Scene const scene = read_scene(path, overrides);
    StagePlan const plan = make_stage_plan(scene);
    make_run_state(scene); // walls and files too
    print(scene.resolved);
    print("# ---- what would run");
    long long const grains = print_classes(scene);
    print_time_steps(scene, plan);
    print_fluid(scene);
    print_stages(scene, plan, grains);
    return 0;
}

} // namespace arenite
