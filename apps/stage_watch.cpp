// SPDX-License-Identifier: MIT
#include "apps/stage_watch.hpp"

#include "apps/sample.hpp"
#include "core/error.hpp"
#include "kernels/stress.hpp"
#include "kernels/wall_reactions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace arenite {
namespace {

constexpr int look_interval = 100; // steps between two looks at end conditions that need sums over the grains

std::string name_of_faulty_grain(RunState const& state)
{
    auto const position = Kokkos::create_mirror_view_and_copy(HostSpace(), state.particles.position);
    auto const velocity = Kokkos::create_mirror_view_and_copy(HostSpace(), state.particles.velocity);
    auto const id = Kokkos::create_mirror_view_and_copy(HostSpace(), state.particles.id);
    GrainId faulty = -1;
    Vec3 where;
    for (int i = 0; i < state.particles.count; ++i) {
        Vec3 const x = vector_of(position, i), v = vector_of(velocity, i);
        bool const finite = std::isfinite(dot(x, x)) && std::isfinite(dot(v, v));
        if (finite || (faulty >= 0 && id(i) > faulty)) continue;
        faulty = id(i);
        where = x;
    }
    return fmt::format("grain {} at ({:g}, {:g}, {:g}) m", faulty, where.x, where.y, where.z);
}

/// dt over the limit 2 sqrt(3 m / (10 Z k_t)) of a smallest grain that holds the stiffest contact seen, with Z = 4, the
/// fewest contacts that a grain in a pack with friction rests on. 0 where nothing touches.
Real step_ratio(StageSetup const& setup, Real normal_stiffness)
{
    TimeStepLimits const& limits = setup.planned->limits;
    if (!(normal_stiffness > 0) || !(limits.smallest_mass > 0)) return 0;
    int const material = setup.planned->strictest;
    Real const ratio = setup.planned->pair(material, material).tangential_damping_ratio; // its square is k_t / k_n
    if (!(ratio > 0)) return 0;
    return setup.step.dt / (2 * std::sqrt(3 * limits.smallest_mass / (40 * normal_stiffness * ratio * ratio)));
}

/// Or is as good as infinite: no flow that anybody computes passes a million cells in a step.
bool has_blown_up(FlowReport const& flow) { return !std::isfinite(flow.pressure_residual) || !(flow.courant < 1e6); }

} // namespace

StageWatch::StageWatch(Scene const& scene, PlannedStage const& planned) : scene_(scene), stage_(planned.settings)
{
    // A condition without a duration may take as long as it needs; a duration is a whole number of steps.
    if (stage_.duration > 0)
        last_step_ = static_cast<std::int64_t>(std::llround(std::ceil(stage_.duration / planned.dt * (1 - 1e-12))));
}

Look const& StageWatch::look(StageSetup const& setup, RunState& state)
{
    if (look_.step == state.clock.step) return look_;
    look_.step = state.clock.step;
    look_.grains = report_grains(state.particles, state.sums);
    look_.contacts = setup.forces.report();
    look_.walls = measure_walls(state.particles, state.walls, state.wall_contacts);
    look_.wall_elastic = setup.forces.wall_elastic();
    look_.wall_overlap_ratio = largest_wall_overlap_ratio(state.particles, state.wall_contacts);
    Real const volume = sample_volume(state.walls, state.box);
    look_.energy.reset();
    if (state.energy) look_.energy = energy_sheet(setup, look_.grains, state);
    look_.porosity.reset();
    if (state.particles.count > 0 && volume > 0) look_.porosity = 1 - look_.grains.volume / volume;
    Real& overlap = state.record.highest_overlap_ratio;
    overlap = std::max({overlap, look_.contacts.highest_overlap_ratio, look_.wall_overlap_ratio});
    state.record.highest_step_ratio = std::max(state.record.highest_step_ratio, step_ratio(setup, look_.contacts.stiffness));
    return look_;
}

Real StageWatch::stress_on(std::string const& name, Real area, StageSetup const& setup, RunState& state)
{
    int const wall = state.walls.find(name);
    return wall_stress(state.walls, wall, look(setup, state).walls[wall], area, state.box);
}

bool StageWatch::box_holds_its_stress(StageSetup const& setup, RunState& state) const
{
    Vec3 const stress = mean_stress(state.particles, state.box, state.contacts, state.sums);
    BoxSettings const& box = *setup.planned->settings.box;
    for (int axis = 0; axis < 3; ++axis) {
        if (!box.stress[axis]) continue;
        Real const target = *box.stress[axis];
        if (!(std::fabs(stress[axis] - target) <= *stage_.end.box_stress_tolerance * std::fabs(target))) return false;
    }
    return true;
}

bool StageWatch::conditions_hold(StageSetup const& setup, RunState& state)
{
    EndSettings const& end = stage_.end;
    if (end.wall_travel_done)
        for (WallState const& wall : state.walls.state)
            if (!wall.program.done) return false;
    if (!end.position_wall.empty()) {
        int const wall = state.walls.find(end.position_wall);
        Real const start = state.walls.state[wall].program.start_position[end.position_axis];
        Real const now = state.walls.state[wall].position[end.position_axis];
        if ((now - end.position) * (start - end.position) > 0) return false;
    }
    bool const needs_look = end.box_stress_tolerance || end.kinetic_energy || end.kinetic_energy_ratio || end.porosity ||
                            !end.stress_wall.empty();
    if (!needs_look) return true;
    if (state.clock.stage_step == 0 || state.clock.stage_step % look_interval != 0) return false;
    Look const& now = look(setup, state);
    if (end.kinetic_energy && !(now.grains.kinetic_energy() < *end.kinetic_energy)) return false;
    if (end.kinetic_energy_ratio && !(now.grains.kinetic_energy() < *end.kinetic_energy_ratio * now.elastic_energy()))
        return false;
    if (end.box_stress_tolerance && !box_holds_its_stress(setup, state)) return false;
    if (end.porosity && !(now.porosity.value_or(1) <= *end.porosity)) return false;
    if (!end.stress_wall.empty()) {
        Real const stress = stress_on(end.stress_wall, end.stress_area, setup, state);
        if (!(std::fabs(stress - end.stress) <= end.stress_tolerance * end.stress)) return false;
    }
    return true;
}

void StageWatch::tune_friction(StageSetup& setup, RunState& state)
{
    if (state.tuned_friction < 0 || state.clock.stage_step % look_interval != 0) return;
    for (WallAction const& action : stage_.walls) {
        if (!action.servo) continue;
        int const wall = state.walls.find(action.wall);
        Real const target = state.walls.state[wall].servo.target;
        Look const& now = look(setup, state);
        Real const pressing = dot(now.walls[wall].force, state.walls.state[wall].servo.axis) * -1;
        bool const pressed = pressing > Real(0.5) * target; // the servo comes the faster, the farther it is from its target
        // Slowly enough that the pack follows: a factor of two in some two thousand steps.
        if (pressed && now.porosity.value_or(0) > stage_.target_porosity)
            set_friction(setup, state, Real(0.967) * state.tuned_friction);
    }
}

std::optional<std::string> StageWatch::has_ended(StageSetup& setup, RunState& state)
{
    bool const timed_out = last_step_ > 0 && state.clock.stage_step >= last_step_;
    if (!stage_.end.any()) return timed_out || stage_.duration <= 0 ? std::optional<std::string>("duration") : std::nullopt;
    if (conditions_hold(setup, state)) return "conditions met";
    if (timed_out) return "duration, conditions not met";
    tune_friction(setup, state);
    return {};
}

void StageWatch::check_health(StageSetup const&, RunState& state) const
{
    if (state.fluid && has_blown_up(state.fluid->report))
        throw SimulationError(fmt::format(
            "stage \"{}\", step {}: the flow is not finite any more (Courant number {:.3g}): the fluid's time step "
            "is too large, or its boundary conditions contradict each other",
            stage_.name, state.clock.step, state.fluid->report.courant));
    if (!(read_health(state.integrator) & force_is_not_finite)) return;
    throw SimulationError(
        fmt::format("stage \"{}\", step {}: the force on {} is not finite: the time step is too large or grains "
                    "overlap wholly",
                    stage_.name, state.clock.step, name_of_faulty_grain(state)));
}

} // namespace arenite
