// SPDX-License-Identifier: MIT
#include "apps/stage_setup.hpp"

#include "apps/make_state.hpp"
#include "apps/sample.hpp"
#include "apps/seconds_of.hpp"
#include "core/error.hpp"
#include "core/wall_motion.hpp"
#include "kernels/contact_search.hpp"
#include "kernels/diagnostics.hpp"
#include "kernels/production.hpp"
#include "kernels/stress.hpp"
#include "kernels/wall_reactions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace arenite {
namespace {

/// From the scene's smallest grain, which may have left the run: the limits are the same after a resume.
void set_skin_limits(StageSetup& setup, RunState& state)
{
    Real const known = setup.planned->limits.smallest_diameter;
    Real const smallest_diameter = known > 0 ? known : Real(1); // any, where there are no grains
    Real reach = 0;                                             // how far apart adhering grains can be
    for (auto const* pairs : {&setup.planned->pairs, &setup.planned->wall_pairs})
        for (PairConstants const& pair : *pairs)
            if (pair.surface_energy > 0)
                reach = std::max(reach, -pair.break_overlap * pair.length_factor * std::cbrt(10 * smallest_diameter));
    setup.smallest_diameter = smallest_diameter;
    setup.least_skin = std::max(least_relative_skin * smallest_diameter, 4 * reach);
    setup.most_skin = std::max(most_relative_skin * smallest_diameter, setup.least_skin);
    if (!(state.skin > 0)) state.skin = Real(0.1) * smallest_diameter;
    state.skin = std::clamp(state.skin, setup.least_skin, setup.most_skin);
}

/// The corner of the sample at the end that a plane faces.
Vec3 far_end(Vec3 const& normal, Region const& sample)
{
    Vec3 corner = sample.lower;
    for (int n = 0; n < 3; ++n)
        if (normal[n] > 0) corner[n] = sample.upper[n];
    return corner;
}

/// The sample strains about the end that is opposite to the carrier.
void hold_far_end(int carrier, RunState& state)
{
    Vec3 const axis = axis_of(state.walls, carrier), end = far_end(axis, sample_region(state.walls, state.box));
    for (int n = 0; n < 3; ++n)
        if (std::fabs(axis[n]) >= Real(0.5)) state.box.strain_origin[n] = end[n];
}

/// It strains as the carrier moves.
void ride_on_carrier(int carrier, RunState& state)
{
    Vec3 const axis = axis_of(state.walls, carrier);
    WallState const& wall = state.walls.state[carrier];
    hold_far_end(carrier, state);
    state.box.strain_rate = {};
    for (int n = 0; n < 3; ++n)
        if (std::fabs(axis[n]) >= Real(0.5))
            state.box.strain_rate[n] = wall.velocity[n] / (wall.position[n] - state.box.strain_origin[n]);
}

/// Planes and the servos' default areas are those of the domain as it is now.
void fit_walls_to_box(RunState& state)
{
    state.walls.lower = state.box.lower;
    state.walls.upper = state.box.upper;
}

void follow_box(StageSetup& setup, RunState const& state)
{
    setup.step.strain_rate = state.box.strain_rate;
    setup.step.strain_origin = state.box.strain_origin;
}

/// What a stage does with its walls. A densifying plate goes as far as the sample leaves it, now that it is here.
std::vector<WallAction> wall_actions(PlannedStage const& planned, RunState& state)
{
    std::vector<WallAction> actions = planned.settings.walls;
    if (planned.part != CompressionPart::densify) return actions;
    for (WallAction& action : actions) {
        if (action.wall != planned.settings.carrier) continue;
        int const wall = state.walls.find(action.wall);
        Region const sample = sample_region(state.walls, state.box);
        Vec3 const axis = normalized(*action.velocity);
        Real const solid = report_grains(state.particles, state.sums).volume;
        Real const height = solid / (cross_section(sample.upper - sample.lower, axis) * (1 - planned.porosity));
        action.travel = std::fabs(dot(state.walls.state[wall].position - far_end(axis, sample), axis)) - height;
        if (*action.travel > 0) continue;
        action.velocity.reset(); // dense enough already
        action.travel.reset();
    }
    return actions;
}

StageSetup make_setup(Scene const& scene, PlannedStage const& planned, RunState& state)
{
    StageSettings const& stage = planned.settings;
    StageSetup setup;
    setup.planned = &planned;
    setup.forces = make_stage_forces(planned, state.tuned_friction, state);
    setup.step.dt = planned.dt;
    setup.step.gravity = stage.gravity.value_or(scene.domain.gravity);
    setup.step.local_damping = stage.local_damping;
    state.box.strain_origin = state.box.lower;
    fit_walls_to_box(state);
    if (!stage.outlet_wall.empty()) setup.outlet = state.walls.find(stage.outlet_wall);
    if (!stage.carrier.empty()) setup.carrier = state.walls.find(stage.carrier);
    if (setup.carrier >= 0) hold_far_end(setup.carrier, state);
    follow_box(setup, state);
    setup.walls_move = any_wall_moves(state.walls);
    setup.known.step = state.clock.step;
    set_skin_limits(setup, state);
    return setup;
}

/// The lists of a checkpoint, which was written in between two searches.
void take_up_lists(StageSetup& setup, RunState& state)
{
    complete_list(state.particles, state.contacts);
    complete_wall_contacts(state.particles, state.walls, state.wall_contacts);
    setup.step.allowed_move = state.skin / 2;
}

/// How the rate of an axis that holds a stress answers to the miss, the relative error of that stress. In proportion, with
/// the largest rate at a miss of 1: where nothing else moves, the sample comes to rest at its stress, since such a box only
/// takes energy. But where another axis is driven, this one has to move on for as long (a sheared sample bulges at up to the
/// axial rate), and would have a lasting miss of that rate over the largest: a tenth in stiff cemented sand. A larger
/// largest rate is no way out, because above 2 target / (K t), with the sample's stiffness K and the time t between two
/// looks, the box rings. So there the rate that lasts is summed up from the misses, in as many looks as keep it from ringing
/// with the proportional part, and taken off; in a box that is not driven that sum would shake the sample and keep it from
/// its rest. A large miss is one of a sample that has lost its contacts or not found them yet: what it asks for passes.
constexpr Real looks_to_learn = 20, large_miss = 0.2;

bool is_driven(BoxSettings const& box)
{
    return std::any_of(box.strain_rate.begin(), box.strain_rate.end(),
                       [](auto const& rate) { return rate.value_or(0) != 0; });
}

/// Strain rate [1/s] until the next look. lasting_rate [1/s]: what was learnt, if it is to be.
Real servo_strain_rate(Real miss, Real largest, bool learns, Real& lasting_rate)
{
    if (learns && std::fabs(miss) < large_miss)
        lasting_rate = std::clamp(lasting_rate + miss / looks_to_learn * largest, -largest, largest);
    return std::clamp(lasting_rate + miss * largest, -largest, largest);
}

/// It is time to look at the stress of a box that is to hold one.
bool box_is_due(StageSetup const& setup, RunState const& state)
{
    constexpr int interval = 10; // steps
    auto const& box = setup.planned->settings.box;
    return box && box->holds_stress() && state.clock.stage_step % interval == 0;
}

/// The box follows the step that the grains just made; then it goes on at the rates that the scene gives.
void move_box(StageSetup const& setup, RunState& state)
{
    BoxSettings const& box = *setup.planned->settings.box;
    Vec3 const size = state.box.size();
    for (int axis = 0; axis < 3; ++axis)
        state.box.upper[axis] = state.box.lower[axis] + size[axis] * (1 + setup.step.dt * state.box.strain_rate[axis]);
    for (int axis = 0; axis < 3; ++axis)
        if (box.strain_rate[axis]) state.box.strain_rate[axis] = *box.strain_rate[axis];
    fit_walls_to_box(state);
}

/// The next rates of axes that hold a stress: those that bring it to its target. All launched steps must have been made.
void steer_box(StageSetup& setup, RunState& state)
{
    Phase const phase("box stress");
    BoxSettings const& box = *setup.planned->settings.box;
    Vec3 const stress = mean_stress(state.particles, state.box, state.contacts, state.sums);
    bool const driven = is_driven(box);
    for (int axis = 0; axis < 3; ++axis)
        if (box.stress[axis]) {
            Real const miss = (stress[axis] - *box.stress[axis]) / std::max(std::fabs(*box.stress[axis]), Real(1));
            state.box.strain_rate[axis] =
                servo_strain_rate(miss, box.max_strain_rate, driven, state.lasting_strain_rate[axis]);
        }
    setup.step.strain_rate = state.box.strain_rate;
}

void advance_walls(StageSetup& setup, RunState& state)
{
    if (setup.walls_move) move_walls(state.walls, setup.step.dt);
    if (setup.planned->settings.box) move_box(setup, state);
    if (setup.carrier >= 0) ride_on_carrier(setup.carrier, state);
    follow_box(setup, state);
}

/// Back to the step after the drift that found the list stale. Of what the host does in a step only the programs of walls
/// and box, and what rides on them, go on without knowing: they are run again from where they were known.
void go_back(StageSetup& setup, RunState& state, int steps)
{
    state.clock.step -= steps;
    state.clock.stage_step -= steps;
    if (setup.walls_move) state.walls.state = setup.known.walls;
    state.box = setup.known.box;
    for (std::int64_t step = setup.known.step; step < state.clock.step; ++step) advance_walls(setup, state);
}

/// How long the list has lasted, of how long a list with this skin s should last. A skin costs a step 0.3 s/d of its time,
/// in candidates that do not touch, and a search as much as 16 steps (d: the smallest diameter; pack of 33 752 grains, JKR,
/// one thread, Zen 3, ea8d7fa). Both together are least where they are equal, with lists of 53 d/s steps. Shorter ones of
/// balanced_list_age d/s steps cost an eighth of that more and keep less in memory.
Real age_of_list(StageSetup const& setup, RunState const& state)
{
    return static_cast<Real>(state.clock.step - state.last_search) * state.skin /
           (balanced_list_age * setup.smallest_diameter);
}

/// Lists last in proportion to their skin, and age as its square.
void renew_lists(StageSetup& setup, RunState& state)
{
    Real const factor = 1 / std::sqrt(std::max(age_of_list(setup, state), Real(1e-9)));
    state.skin = std::clamp(state.skin * std::clamp(factor, Real(0.5), Real(2)), setup.least_skin, setup.most_skin);
    search(setup, state);
}

void search_lists(StageSetup& setup, RunState& state, View1<int> const& keep)
{
    try {
        // A box that holds a stress looks at it between steps, a balance after every step.
        auto const& box = setup.planned->settings.box;
        SearchSettings settings{state.skin, setup.forces.needs, keep};
        settings.whole_steps = state.energy || (box && box->holds_stress());
        settings.forces_follow = !keep.is_allocated(); // grains are removed when fields and tables may be due
        search_contacts(state.particles, state.box, settings, state.contacts);
    } catch (InputError const& error) {
        if (state.clock.stage_step == 0) throw;
        throw SimulationError(error.what()); // the scene was sound when the stage began
    }
    search_wall_contacts(state.particles, state.walls, state.skin, setup.forces.wall_needs, state.wall_contacts);
}

} // namespace

StageSetup begin_stage(Scene const& scene, PlannedStage const& planned, RunState& state)
{
    StageSettings const& stage = planned.settings;
    if (stage.kind == StageKind::generation) {
        generate_particles(scene, state);
        return {};
    }
    fit_walls_to_box(state);
    begin_stage(state.walls, wall_actions(planned, state));
    apply_groups(scene, scene.stages[planned.scene_stage].name, state.groups, state.particles);
    state.clock.dt = planned.dt;
    state.stage_tally = state.tally;
    state.record = {};
    state.box.strain_rate = state.lasting_strain_rate = {};
    if (stage.box)
        for (int axis = 0; axis < 3; ++axis) state.box.strain_rate[axis] = stage.box->strain_rate[axis].value_or(0);
    state.tuned_friction = stage.target_porosity > 0 ? planned.grain_friction : -1;
    prepare_fluid(scene, planned, state);
    StageSetup setup = make_setup(scene, planned, state);
    search(setup, state);
    if (setup.forces.form_bonds) setup.forces.form_bonds();
    evaluate_all(setup.forces, state, 0); // no time passes: springs and wall poses stay
    StepSettings still = setup.step;
    still.dt = 0;
    kick(state.integrator, still, state.particles, state.contacts, force_rows(state.wall_contacts));
    return setup;
}

StageSetup resume_stage(Scene const& scene, PlannedStage const& planned, RunState& state)
{
    StageSetup setup = make_setup(scene, planned, state);
    take_up_lists(setup, state);
    return setup;
}

void set_friction(StageSetup& setup, RunState& state, Real friction)
{
    state.tuned_friction = friction;
    setup.forces = make_stage_forces(*setup.planned, friction, state);
}

void search(StageSetup& setup, RunState& state, View1<int> const& keep)
{
    setup.search_time += seconds_of([&] { search_lists(setup, state, keep); });
    setup.step.allowed_move = state.skin / 2;
    state.last_search = state.clock.step;
    ++setup.searches;
}

void search(StageSetup& setup, RunState& state) { search(setup, state, {}); }

void follow_drift(StageSetup& setup, RunState& state, bool must_know)
{
    if (setup.known.step == state.clock.step) {
        if (setup.walls_move) setup.known.walls = state.walls.state;
        setup.known.box = state.box;
    }
    ++state.clock.step;
    ++state.clock.stage_step;
    advance_walls(setup, state);
    bool const walls_came_near =
        setup.walls_move && wall_displacement(state.walls, state.wall_contacts.reference_pose) > setup.step.allowed_move;
    bool const outlived = state.skin > setup.least_skin && age_of_list(setup, state) > 4;
    bool const host_acts = walls_came_near || outlived || box_is_due(setup, state) || servo_is_due(state.walls);
    if (!must_know && !host_acts && !says_stale(state.integrator)) return;
    int const in_vain = take_stale(state.integrator);
    if (in_vain > 0) go_back(setup, state, in_vain);
    if (box_is_due(setup, state)) steer_box(setup, state); // of the step that it may have gone back to
    if (in_vain >= 0 || walls_came_near || outlived) renew_lists(setup, state);
    setup.known.step = state.clock.step;
}

void drive_servos(StageSetup const& setup, RunState& state)
{
    if (setup.walls_move && servo_is_due(state.walls))
        update_servos(state.walls, measure_walls(state.particles, state.walls, state.wall_contacts), setup.step.dt);
}

bool remove_departed(StageSetup& setup, RunState& state, RunOutput& output)
{
    Departures const departures = find_departures(state.particles, state.box, state.walls, setup.outlet);
    if (!departures.keep.is_allocated()) return false;
    Real const energy_before = state.energy ? energy_now(setup, state) : 0;
    for (Grain const& grain : departures.produced) {
        output.write_produced(grain, state);
        state.tally.produced_mass += output.mass_of(grain);
    }
    state.tally.produced_count += static_cast<std::int64_t>(departures.produced.size());
    for (Grain const& grain : departures.lost) {
        output.warn("lost_grains", fmt::format("grain {} left the domain at ({:.4g}, {:.4g}, {:.4g}) m in step {}", grain.id,
                                               grain.position.x, grain.position.y, grain.position.z, state.clock.step));
        state.tally.lost_mass += output.mass_of(grain);
    }
    state.tally.lost_count += static_cast<std::int64_t>(departures.lost.size());
    search(setup, state, departures.keep);
    if (state.energy) state.energy->removed += energy_before - energy_now(setup, state);
    return true;
}

} // namespace arenite
