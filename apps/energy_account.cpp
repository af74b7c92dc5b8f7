// SPDX-License-Identifier: MIT
#include "apps/energy_account.hpp"

#include "apps/run_state.hpp"
#include "apps/stage_setup.hpp"

namespace arenite {
namespace {

/// Where the terms of a step's powers are.
enum Place : int {
    of_pairs = 0,
    of_walls = of_pairs + contact_power_terms,
    of_grains = of_walls + contact_power_terms,
    of_moving_walls = of_grains + grain_power_terms, // at the step's begin
    place_count
};

/// What a deforming box puts in against forces of this virial [J], W.
KOKKOS_FUNCTION Real box_power(Vec3 const& strain_rate, Vec3 const& virial) { return -dot(strain_rate, virial); }

/// What is done with the powers of a moment.
enum class Purpose { open, take_up, add };

/// One thread's work: the powers of this moment from their sums, and the account with them.
struct PowerTally {
    Kokkos::View<WorkSums, MemorySpace> sums;
    View1<Real> terms;
    Vec3 strain_rate;
    bool has_local_damping;
    Purpose purpose;
    Real half_dt;
    StepGate gate;

    KOKKOS_FUNCTION void operator()(int) const
    {
        if (gate.closed()) return;
        WorkSums& account = sums();
        ContactPower const pairs = contact_power(terms.data() + of_pairs), walls = contact_power(terms.data() + of_walls);
        GrainPower const grains = grain_power(terms.data() + of_grains);
        account.virial = pairs.virial + walls.virial + grains.virial;
        if (purpose == Purpose::take_up) return;
        WorkArray const power = powers(pairs, walls, grains, account.virial);
        if (purpose == Purpose::add) {
            for (int n = 0; n < work_count; ++n)
                account.work.values[n] += half_dt * (account.power.values[n] + power.values[n]);
            account.adhesion += pairs.adhesion + walls.adhesion; // the jump of stored energy in the step that led here
        }
        account.power = power;
    }

    KOKKOS_FUNCTION WorkArray powers(ContactPower const& pairs, ContactPower const& walls, GrainPower const& grains,
                                     Vec3 const& virial) const
    {
        WorkArray power;
        power[Work::walls] = walls.walls;
        power[Work::box] = box_power(strain_rate, virial);
        power[Work::gravity] = grains.gravity;
        power[Work::drag] = grains.drag;
        power[Work::pressure] = grains.pressure;
        power[Work::applied] = grains.applied;
        power[Work::held] = grains.held;
        power[Work::normal_damping] = pairs.damping + walls.damping;
        power[Work::tangential] = pairs.tangential + walls.tangential;
        // Damping of the total force is what the other forces leave; without it nothing is left, and an error of the
        // gather shows in the residual instead.
        if (has_local_damping)
            power[Work::local_damping] =
                grains.total - (pairs.on_grains + walls.on_grains + grains.outer() + box_power(strain_rate, grains.virial));
        return power;
    }
};

/// Walls and a deforming box have one velocity for the whole step (a servo sets another for the next): the forces at the
/// step's begin work on that one too.
struct NewVelocities {
    Kokkos::View<WorkSums, MemorySpace> sums;
    View1<Real> terms;
    Vec3 strain_rate;
    bool of_a_wall, of_the_box;
    StepGate gate;

    KOKKOS_FUNCTION void operator()(int) const
    {
        if (gate.closed()) return;
        WorkSums& account = sums();
        if (of_a_wall) account.power[Work::walls] = terms(of_moving_walls);
        if (of_the_box) account.power[Work::box] = box_power(strain_rate, account.virial);
    }
};

/// Sums the powers of this moment and does with them what they are for. Nobody waits.
void tally_powers(StageSetup const& setup, RunState& state, Purpose purpose)
{
    EnergyAccount& account = *state.energy;
    Vec3 const origin = setup.step.strain_origin;
    setup.forces.sum_pair_power(account.terms.data() + of_pairs, account.pair_adhered);
    setup.forces.sum_wall_power(account.terms.data() + of_walls, account.wall_adhered, origin);
    sum_grain_power(account.terms.data() + of_grains, state.particles, setup.step.gravity, state.box, origin, state.sums);
    Kokkos::parallel_for("tally_powers", RangePolicy(0, 1),
                         PowerTally{account.sums, account.terms, state.box.strain_rate, setup.step.local_damping > 0,
                                    purpose, Real(0.5) * setup.step.dt, state.integrator.gate()});
}

struct KeepFlags {
    View1<std::uint8_t> flags, kept;
    KOKKOS_FUNCTION void operator()(int n) const { kept(n) = flags(n); }
};

/// Of a list that is new. A kernel and no deep_copy, and memory that only grows: neither makes the host wait.
void keep(View1<std::uint8_t> const& flags, View1<std::uint8_t>& kept)
{
    if (flags.extent(0) == 0) {
        kept = {};
        return;
    }
    if (kept.extent(0) < flags.extent(0)) kept = View1<std::uint8_t>(uninitialized("adhered"), flags.extent(0));
    Kokkos::parallel_for("keep_flags", RangePolicy(0, flags.extent_int(0)), KeepFlags{flags, kept});
}

} // namespace

EnergyAccount::EnergyAccount() : sums("energy_sums"), terms(uninitialized("energy_terms"), place_count) {}

WorkSums EnergyAccount::read_sums() const
{
    WorkSums now;
    Kokkos::deep_copy(now, sums);
    return now;
}

void EnergyAccount::write_sums(WorkSums const& now) const { Kokkos::deep_copy(sums, now); }

void open_account(StageSetup const& setup, RunState& state)
{
    EnergyAccount& account = state.energy.emplace();
    tally_powers(setup, state, Purpose::open);
    account.start = energy_now(setup, state);
    account.start_tangential = setup.forces.stored().tangential;
}

void take_up_account(StageSetup const& setup, RunState& state) { tally_powers(setup, state, Purpose::take_up); }

void begin_step(StageSetup const& setup, RunState& state)
{
    EnergyAccount& account = *state.energy;
    if (account.flags_of != setup.searches) {
        keep(state.contacts.adhering, account.pair_adhered);
        keep(state.wall_contacts.adhering, account.wall_adhered);
        account.flags_of = setup.searches;
    }
    bool const rides = setup.carrier >= 0 || setup.planned->settings.box;
    if (!setup.walls_move && !rides) return;
    if (setup.walls_move) setup.forces.sum_wall_work(account.terms.data() + of_moving_walls);
    Kokkos::parallel_for(
        "new_velocities", RangePolicy(0, 1),
        NewVelocities{account.sums, account.terms, state.box.strain_rate, setup.walls_move, rides, state.integrator.gate()});
}

void add_step(StageSetup const& setup, RunState& state) { tally_powers(setup, state, Purpose::add); }

Real energy_now(StageSetup const& setup, RunState& state)
{
    return report_grains(state.particles, state.sums).kinetic_energy() + setup.forces.stored().total();
}

EnergySheet energy_sheet(StageSetup const& setup, GrainReport const& grains, RunState const& state)
{
    EnergyAccount const& account = *state.energy;
    WorkSums const sums = account.read_sums();
    EnergySheet sheet;
    sheet.stored = setup.forces.stored();
    sheet.work = sums.work;
    sheet.loss_normal_damping = -sums.work[Work::normal_damping];
    sheet.loss_tangential = -sums.work[Work::tangential] - (sheet.stored.tangential - account.start_tangential);
    sheet.loss_local_damping = -sums.work[Work::local_damping];
    sheet.loss_adhesion = -sums.adhesion;
    sheet.removed = account.removed;
    Real outer = 0;
    for (Work const which : {Work::walls, Work::box, Work::gravity, Work::drag, Work::pressure, Work::applied, Work::held})
        outer += sums.work[which];
    Real const losses = sheet.loss_normal_damping + sheet.loss_tangential + sheet.loss_local_damping + sheet.loss_adhesion;
    sheet.residual = grains.kinetic_energy() + sheet.stored.total() - account.start - outer + losses + sheet.removed;
    return sheet;
}

} // namespace arenite
