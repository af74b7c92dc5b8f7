// SPDX-License-Identifier: MIT
#include "apps/calibrate.hpp"

#include "apps/given_grains.hpp"
#include "apps/make_state.hpp"
#include "apps/stage_loop.hpp"
#include "apps/stage_setup.hpp"
#include "apps/view_memory.hpp"
#include "io/scene_reader.hpp"

#include <algorithm>
#include <chrono>
#include <functional>

namespace arenite {
namespace {

/// As many grains as the scene will have, all of the mean volume, on a cubic lattice that stands on the domain's floor.
std::vector<Grain> lattice_of(Scene const& scene)
{
    constexpr Real overlap = 1e-3; // of the diameter: what 1 MPa makes of sand
    DistributionSettings const& distribution = scene.particles.distribution;
    Region const region = distribution.region.value_or(Region{scene.domain.lower, scene.domain.upper});
    Vec3 const size = region.upper - region.lower;
    long long count = 0;
    for (SizeClass const& c : make_size_classes(distribution, scene.coarse_graining, size.x * size.y * size.z))
        count += c.count;
    Grain grain;
    grain.diameter = scene.coarse_graining.factor * mean_volume_diameter(distribution);
    grain.material = std::max(0, material_row(scene, scene.particles.material));
    Real const spacing = grain.diameter * (1 - overlap);
    auto const fit = [&](Real length) { return std::max(0ll, static_cast<long long>((length - grain.diameter) / spacing)) + 1; };
    long long const along_x = fit(size.x), along_y = fit(size.y);
    std::vector<Grain> grains;
    for (long long n = 0; n < count; ++n) {
        long long const layer = n / along_x / along_y;
        Vec3 const place{static_cast<Real>(n % along_x), static_cast<Real>(n / along_x % along_y), static_cast<Real>(layer)};
        grain.position = region.lower + Vec3{1, 1, 1} * (grain.diameter / 2) + spacing * place;
        grains.push_back(grain);
    }
    return grains;
}

double seconds_of(std::function<void()> const& work)
{
    Kokkos::fence();
    auto const begin = std::chrono::steady_clock::now();
    work();
    Kokkos::fence();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Seconds of one grain step: as many as take a fifth of a second, five at least.
double time_steps(StageSetup& setup, RunState& state)
{
    auto const run = [&](int steps) {
        state.clock.stage_step = 0;
        Cadence cadence;
        cadence.until = steps;
        return seconds_of([&] {
                   while (state.clock.stage_step < steps) advance(setup, cadence, state);
               }) / steps;
    };
    double const guess = run(5);
    return run(static_cast<int>(std::clamp(0.2 / guess, 5.0, 2000.0)));
}

} // namespace

StageCost measure_stage(Scene const& scene, PlannedStage const& planned)
{
    ViewMemory const memory;
    RunState state = make_run_state(scene);
    if (scene.particles.source == ParticleSource::distribution) set_particles(scene, lattice_of(scene), state);
    PlannedStage still = planned;
    still.settings.walls.clear();
    still.settings.box.reset();
    still.settings.carrier.clear();
    StageSetup setup = begin_stage(scene, still, state);
    if (scene.output.energies) open_account(setup, state);
    StageCost cost;
    if (state.fluid) {
        auto const step = [&] { advance_fluid(*state.fluid, state.particles, planned.coupling_interval * planned.dt); };
        seconds_of(step); // the first starts from nothing
        cost.fluid_step = seconds_of(step);
    }
    if (state.particles.count > 0) {
        cost.step = time_steps(setup, state);
        cost.search = seconds_of([&] { search(setup, state); });
    }
    cost.memory = memory.peak();
    return cost;
}

} // namespace arenite
