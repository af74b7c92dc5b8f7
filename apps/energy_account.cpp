// SPDX-License-Identifier: MIT
#include "apps/energy_account.hpp"

#include "apps/run_state.hpp"
#include "apps/stage_setup.hpp"

namespace arenite {
namespace {

using Powers = std::array<Real, work_count>;

/// Powers at this moment, and the jump of stored energy in the step that led here.
Powers measure_powers(StageSetup const& setup, RunState& state, Real& adhesion_jump)
{
    EnergyAccount const& account = *state.energy;
    Vec3 const origin = setup.step.box_lower;
    ContactPower const pairs = setup.forces.pair_power(account.pair_adhered);
    ContactPower const walls = setup.forces.wall_power(account.wall_adhered, origin);
    GrainPower const grains = measure_grain_power(state.particles, setup.step.gravity, state.box, origin, state.sums);
    adhesion_jump = pairs.adhesion + walls.adhesion;
    Powers power{};
    auto const put = [&](Work which, Real value) { power[static_cast<int>(which)] = value; };
    put(Work::walls, walls.walls);
    put(Work::box, pairs.box + walls.box + grains.box);
    put(Work::gravity, grains.gravity);
    put(Work::drag, grains.drag);
    put(Work::pressure, grains.pressure);
    put(Work::applied, grains.applied);
    put(Work::held, grains.held);
    put(Work::normal_damping, pairs.damping + walls.damping);
    put(Work::tangential, pairs.tangential + walls.tangential);
    // Damping of the total force is what the other forces leave; without it nothing is left, and an error of the
    // gather shows in the residual instead.
    if (setup.step.local_damping > 0)
        put(Work::local_damping, grains.total - (pairs.on_grains + walls.on_grains + grains.outer() + grains.box));
    return power;
}

Real& power_of(EnergyAccount& account, Work which) { return account.power[static_cast<int>(which)]; }

StoredEnergy stored_now(StageSetup const& setup) { return setup.forces.stored(); }

} // namespace

void open_account(StageSetup const& setup, RunState& state)
{
    state.energy.emplace();
    EnergyAccount& account = *state.energy;
    Real jump = 0;
    account.power = measure_powers(setup, state, jump);
    account.start = energy_now(setup, state);
    account.start_tangential = stored_now(setup).tangential;
}

void note_contacts(StageSetup const& setup, RunState& state)
{
    // Walls and a deforming box have one velocity for the whole step (a servo sets another for the next): the forces at
    // the step's begin work on that one too.
    Vec3 const origin = setup.step.box_lower;
    bool const rides = setup.carrier >= 0 || setup.planned->settings.box;
    if (setup.walls_move || rides) {
        ContactPower const walls = setup.forces.wall_power({}, origin);
        power_of(*state.energy, Work::walls) = walls.walls;
        if (rides)
            power_of(*state.energy, Work::box) = setup.forces.pair_power({}).box + walls.box +
                                                 measure_grain_power(state.particles, setup.step.gravity, state.box, origin, state.sums).box;
    }
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
}

void add_step(StageSetup const& setup, RunState& state)
{
    EnergyAccount& account = *state.energy;
    Real jump = 0;
    Powers const power = measure_powers(setup, state, jump);
    for (int n = 0; n < work_count; ++n) account.work[n] += Real(0.5) * setup.step.dt * (account.power[n] + power[n]);
    account.power = power;
    account.adhesion += jump;
}

Real energy_now(StageSetup const& setup, RunState& state)
{
    return report_grains(state.particles, state.sums).kinetic_energy() + stored_now(setup).total();
}

EnergySheet energy_sheet(StageSetup const& setup, RunState& state)
{
    EnergyAccount const& account = *state.energy;
    GrainReport const grains = report_grains(state.particles, state.sums);
    EnergySheet sheet;
    sheet.translation = grains.translation;
    sheet.rotation = grains.rotation;
    sheet.stored = stored_now(setup);
    sheet.work = account.work;
    sheet.loss_normal_damping = -account.of(Work::normal_damping);
    sheet.loss_tangential = -account.of(Work::tangential) - (sheet.stored.tangential - account.start_tangential);
    sheet.loss_local_damping = -account.of(Work::local_damping);
    sheet.loss_adhesion = -account.adhesion;
    sheet.removed = account.removed;
    Real outer = 0;
    for (Work const which : {Work::walls, Work::box, Work::gravity, Work::drag, Work::pressure, Work::applied, Work::held})
        outer += account.of(which);
    Real const losses = sheet.loss_normal_damping + sheet.loss_tangential + sheet.loss_local_damping + sheet.loss_adhesion;
    sheet.residual = sheet.total() - account.start - outer + losses + sheet.removed;
    return sheet;
}

} // namespace arenite
