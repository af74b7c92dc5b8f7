// SPDX-License-Identifier: MIT
// The balance sheet of a stage: what its grains hold, and what was done to them since the stage began, by mechanism. Kept
// step by step because friction and dashpots leave nothing behind to measure; a run that asks for no balance has none.
//
// With velocity Verlet the change of kinetic energy over a step is the trapezoidal sum of force times displacement, so
// works are integrated by that rule: the residual of a smooth motion falls with dt^2.
#pragma once

#include "kernels/energy_terms.hpp"

namespace arenite {

/// What is integrated over time, in the order of the arrays below.
enum class Work : int {
    walls, // of moving walls on the grains
    box,   // of the deforming box, or of the flow on which grains ride with a carrier
    gravity,
    drag,           // of the fluid, on the slip
    pressure,       // of the fluid, -grad p + div tau on the grains' volume
    applied,        // constant forces of groups
    held,           // of whatever holds or moves grains of prescribed motion
    normal_damping, // on the grains: the negative of what dashpots took
    tangential,     // likewise, springs and dashpots in the contact plane
    local_damping,  // likewise
};
inline constexpr int work_count = 10;

struct WorkArray {
    Real values[work_count] = {};
    KOKKOS_FUNCTION Real& operator[](Work which) { return values[static_cast<int>(which)]; }
    KOKKOS_FUNCTION Real operator[](Work which) const { return values[static_cast<int>(which)]; }
};

/// What every step adds to. It lies with the grains, so that a step in balance makes the host wait no more than another.
struct WorkSums {
    WorkArray power;   // W, at the last step
    WorkArray work;    // J, since the stage began
    Real adhesion = 0; // J by which stored energy jumped where contacts began or ceased to adhere
    Vec3 virial;       // J, of all forces at the last step
};

struct EnergyAccount {
    Kokkos::View<WorkSums, MemorySpace> sums;
    Real removed = 0;                     // J that grains took with them when they left
    Real start = 0, start_tangential = 0; // J, total and of the tangential springs when the stage began

    View1<Real> terms;                              // scratch: of a step's powers
    View1<std::uint8_t> pair_adhered, wall_adhered; // scratch: the flags when the last step's powers were summed
    std::int64_t flags_of = -1;                     // of which list in this stage: how many searches came before

    EnergyAccount();
    WorkSums read_sums() const; // waits for the steps that were launched
    void write_sums(WorkSums const& now) const;
};

struct StageSetup;
struct RunState;

/// The sheet of one moment, J.
struct EnergySheet {
    StoredEnergy stored;
    WorkArray work{};
    Real loss_normal_damping = 0, loss_tangential = 0, loss_local_damping = 0;
    // Stored energy that vanished where contacts formed, snapped or broke; negative where it appeared.
    Real loss_adhesion = 0;
    Real removed = 0;
    Real residual = 0; // change of all energies - works + losses + removed: 0 but for the error of integration
};

/// Opens the account of a stage whose first forces stand, or of a resumed one whose checkpoint held none.
void open_account(StageSetup const& setup, RunState& state);

/// Of an account that goes on after a restart: what no checkpoint holds. Forces and places must be those of the last step.
void take_up_account(StageSetup const& setup, RunState& state);

/// Between the walls' move and the evaluation of the step's forces.
void begin_step(StageSetup const& setup, RunState& state);

/// After the step's kick and before servos set the walls' next velocities.
void add_step(StageSetup const& setup, RunState& state);

/// grains: of this moment, for their kinetic energy.
EnergySheet energy_sheet(StageSetup const& setup, GrainReport const& grains, RunState const& state);

/// Kinetic and stored energy now, J: its change over a removal of grains is what they took along.
Real energy_now(StageSetup const& setup, RunState& state);

} // namespace arenite
