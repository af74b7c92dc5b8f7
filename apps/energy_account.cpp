// SPDX-License-Identifier: MIT
#include "apps/energy_account.hpp"

#include "apps/run_state.hpp"
#include "apps/stage_setup.hpp"

namespace arenite {
namespace {

/// What a deforming box puts in against forces of this virial [J], W.
Real box_power(PeriodicBox const& box, Vec3 const& virial) { return -dot(box.strain_rate, virial); }

/// Powers at this moment, and the jump of stored energy in the step that led here.
WorkArray measure_powers(StageSetup const& setup, RunState& state, Real& adhesion_jump)
{
    EnergyAccount& account = *state.energy;
    Vec3 const origin = setup.step.box_lower;
    ContactPower const pairs = setup.forces.pair_power(account.pair_adhered);
    ContactPower const walls = setup.forces.wall_power(account.wall_adhered, origin);
    GrainPower const grains = measure_grain_power(state.particles, setup.step.gravity, state.box, origin, state.sums);
    adhesion_jump = pairs.adhesion + walls.adhesion;
    account.virial = pairs.virial + walls.virial + grains.virial;
    WorkArray power{};
    power[Work::walls] = walls.walls;
    power[Work::box] = box_power(state.box, account.virial);
    power[Work::gravity] = grains.gravity;
    power[Work::drag] = grains.drag;
    power[Work::pressure] = grains.pressure;
    power[Work::applied] = grains.applied;
    power[Work::held] = grains.held;
    power[Work::normal_damping] = pairs.damping + walls.damping;
    power[Work::tangential] = pairs.tangential + walls.tangential;
    // Damping of the total force is what the other forces leave; without it nothing is left, and an error of the
    // gather shows in the residual instead.
    if (setup.step.local_damping > 0)
        power[Work::local_damping] =
            grains.total - (pairs.on_grains + walls.on_grains + grains.outer() + box_power(state.box, grains.virial));
    return power;
}

} // namespace

void open_account(StageSetup const& setup, RunState& state)
{
    state.energy.emplace();
    EnergyAccount& account = *state.energy;
    Real jump = 0;
    account.power = measure_powers(setup, state, jump);
    account.start = energy_now(setup, state);
    account.start_tangential = setup.forces.stored().tangential;
}

void take_up_account(StageSetup const& setup, RunState& state)
{
    Real jump = 0;
    measure_powers(setup, state, jump);
}

void begin_step(StageSetup const& setup, RunState& state)
{
    auto const copy = [](View1<std::uint8_t> const& flags, int count, View1<std::uint8_t>& kept) {
        if (!flags.is_allocated() || count == 0) {
            kept = {};
            return;
        }
        if (kept.extent(0) != flags.extent(0)) kept = View1<std::uint8_t>(uninitialized("adhered"), flags.extent(0));
        Kokkos::deep_copy(ExecutionSpace(), kept, flags);
    };
    copy(state.contacts.adhering, state.contacts.count, state.energy->pair_adhered);
    copy(state.wall_contacts.adhering, state.wall_contacts.count, state.energy->wall_adhered);
    // Walls and a deforming box have one velocity for the whole step (a servo sets another for the next): the forces at
    // the step's begin work on that one too.
    WorkArray& power = state.energy->power;
    if (setup.walls_move) power[Work::walls] = setup.forces.wall_work();
    if (setup.carrier >= 0 || setup.planned->settings.box) power[Work::box] = box_power(state.box, state.energy->virial);
}

void add_step(StageSetup const& setup, RunState& state)
{
    EnergyAccount& account = *state.energy;
    Real jump = 0;
    WorkArray const power = measure_powers(setup, state, jump);
    for (int n = 0; n < work_count; ++n)
        account.work.at(n) += Real(0.5) * setup.step.dt * (account.power.at(n) + power.at(n));
    account.power = power;
    account.adhesion += jump;
}

Real energy_now(StageSetup const& setup, RunState& state)
{
    return report_grains(state.particles, state.sums).kinetic_energy() + setup.forces.stored().total();
}

EnergySheet energy_sheet(StageSetup const& setup, GrainReport const& grains, RunState const& state)
{
    EnergyAccount const& account = *state.energy;
    EnergySheet sheet;
    sheet.stored = setup.forces.stored();
    sheet.work = account.work;
    sheet.loss_normal_damping = -account.work[Work::normal_damping];
    sheet.loss_tangential = -account.work[Work::tangential] - (sheet.stored.tangential - account.start_tangential);
    sheet.loss_local_damping = -account.work[Work::local_damping];
    sheet.loss_adhesion = -account.adhesion;
    sheet.removed = account.removed;
    Real outer = 0;
    for (Work const which : {Work::walls, Work::box, Work::gravity, Work::drag, Work::pressure, Work::applied, Work::held})
        outer += account.work[which];
    Real const losses = sheet.loss_normal_damping + sheet.loss_tangential + sheet.loss_local_damping + sheet.loss_adhesion;
    sheet.residual = grains.kinetic_energy() + sheet.stored.total() - account.start - outer + losses + sheet.removed;
    return sheet;
}

} // namespace arenite
