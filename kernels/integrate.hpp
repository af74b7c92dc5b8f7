// SPDX-License-Identifier: MIT
// Velocity Verlet in its kick-drift-kick form. A step is: drift (half a kick, then the move), evaluate the
// forces at the new positions, kick (gather the forces, then the other half). Between outputs the kick
// of one step and the drift of the next run as one kernel with the same arithmetic in the same order, so
// that writing output does not change a bit.
#pragma once

#include "core/contact_list.hpp"
#include "core/particles.hpp"

namespace arenite {

/// What the step found, read by the host now and then.
enum Health : unsigned {
    healthy = 0,
    list_is_stale = 1,     // a grain moved more than its share of the skin
    force_is_not_finite = 2, // nor may be a position: a lone grain with a bad velocity has no force to show it
};

/// The wall forces as a grain gathers them; empty where no wall is near.
struct WallForceRows {
    View1<int> begin;               // [grain + 1]
    View1<int> contact;             // [entry] rows of a grain's wall contacts, in the order of their elements
    ForceRows force;                // [wall contact] as in ContactList, the grain being first
};

struct StepSettings {
    Real dt = 0;              // s
    Vec3 gravity;             // m/s2
    Real local_damping = 0;   // fraction of the unbalanced force that opposes the motion (Cundall 1987); quasi-static only
    Vec3 strain_rate;         // 1/s, of a deforming box about box_lower (PeriodicBox)
    Vec3 box_lower;           // m
    Real allowed_move = 0;    // m from the reference position before the list is stale
};

struct Integrator {
    Kokkos::View<unsigned, MemorySpace> health; // Health bits, set by the kernels
    Integrator() : health("health") {}
};

/// Gathers contact and wall forces in fixed order, adds gravity, applied and fluid forces, stores the sum and
/// gives the second half of the kick: velocities are then those of the positions' time.
void kick(Integrator const&, StepSettings const&, Particles const&, ContactList const&, WallForceRows const&);

/// First half of the next kick from the stored forces, then the move.
void drift(Integrator const&, StepSettings const&, Particles const&, ContactList const&);

/// kick and drift in one kernel; leaves particles.force as it was.
void kick_and_drift(Integrator const&, StepSettings const&, Particles const&, ContactList const&, WallForceRows const&);

/// Health bits since the last call; clears list_is_stale.
unsigned read_health(Integrator const&);

} // namespace arenite
