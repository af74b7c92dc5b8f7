// SPDX-License-Identifier: MIT
#include "apps/calibrate.hpp"

#include "apps/make_state.hpp"
#include "apps/seconds_of.hpp"
#include "apps/stage_loop.hpp"
#include "apps/stage_setup.hpp"
#include "apps/view_memory.hpp"
#include "core/random.hpp"
#include "io/scene_reader.hpp"

#include <algorithm>
#include <cmath>

namespace arenite {
namespace {

/// As many grains as the scene will have, in their sizes, about the sites of a cubic lattice that stands on the domain's
/// floor. Its spacing is that at which random sizes have 2.6 contacts and 3.3 candidates a grain, as a pressed sample has;
/// the overlaps are no sample's, so the grains must not move.
std::vector<Grain> lattice_of(Scene const& scene)
{
    constexpr Real solid_fraction = 0.9, jitter = 0.3; // of the spacing, from end to end
    DistributionSettings const& distribution = scene.particles.distribution;
    Region const region = generation_region(scene);
    Vec3 const size = region.upper - region.lower;
    auto const classes = make_size_classes(distribution, scene.coarse_graining, size.x * size.y * size.z);
    long long count = 0;
    Real volume = 0;
    for (SizeClass const& c : classes) {
        count += c.count;
        volume += static_cast<Real>(c.count) * sphere_volume(c.diameter / 2);
    }
    Real const spacing = std::cbrt(volume / (static_cast<Real>(std::max(1ll, count)) * solid_fraction));
    auto const fit = [&](Real length) { return std::max(1ll, static_cast<long long>(length / spacing)); };
    long long const along_x = fit(size.x), along_y = fit(size.y);
    std::vector<Grain> grains;
    for (long long n = 0; n < count; ++n) {
        auto const random = [&](int draw) { return random_uniform(1, static_cast<std::uint64_t>(n), draw); };
        auto rank = static_cast<long long>(random(3) * static_cast<Real>(count));
        Grain grain;
        for (SizeClass const& c : classes) {
            if (grain.diameter > 0) break;
            if (rank < c.count) grain.diameter = c.diameter;
            rank -= c.count;
        }
        grain.material = std::max(0, material_row(scene, scene.particles.material));
        Vec3 const site{static_cast<Real>(n % along_x), static_cast<Real>(n / along_x % along_y),
                        static_cast<Real>(n / along_x / along_y)};
        Vec3 const off{random(0) - Real(0.5), random(1) - Real(0.5), random(2) - Real(0.5)};
        grain.position = region.lower + spacing * (site + Vec3{0.5, 0.5, 0.5} + jitter * off);
        grains.push_back(grain);
    }
    return grains;
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
               }) /
               steps;
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
    setup.step.dt *= Real(1e-9); // the same work, and nothing moves
    setup.walls_move = std::any_of(planned.settings.walls.begin(), planned.settings.walls.end(),
                                   [](WallAction const& a) { return a.velocity || a.angular_velocity || a.servo; });
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
