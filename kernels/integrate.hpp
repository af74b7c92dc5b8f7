// SPDX-License-Identifier: MIT
// Velocity Verlet in its kick-drift-kick form. A step is: drift (half a kick, then the move), evaluate the
// forces at the new positions, kick (gather the forces, then the other half). Between outputs the kick
// of one step and the drift of the next run as one kernel with the same arithmetic in the same order, so
// that writing output does not change a bit. The host may launch steps ahead of what it knows (step_gate.hpp).
#pragma once

#include "core/particles.hpp"
#include "kernels/contact_passes.hpp"
#include "kernels/step_gate.hpp"

namespace arenite {

/// What the steps found, read by the host now and then.
enum Health : unsigned {
    healthy = 0,
    force_is_not_finite = 1, // nor may be a position: a lone grain with a bad velocity has no force to show it
};

/// The wall forces as a grain gathers them; empty where no wall is near.
struct WallForceRows {
    View1<int> begin;   // [grain + 1]
    View1<int> contact; // [entry] rows of a grain's wall contacts, in the order of their elements
    ForceRows force;    // [wall contact] as in ContactList, the grain being first
};

struct StepSettings {
    Real dt = 0;            // s
    Vec3 gravity;           // m/s2
    Real local_damping = 0; // fraction of the unbalanced force that opposes the motion (Cundall 1987); quasi-static only
    Vec3 strain_rate;       // 1/s, of the flow that the grains ride on (PeriodicBox)
    Vec3 strain_origin;     // m
    Real allowed_move = 0;  // m from the reference position before the list is stale
};

struct Integrator {
    Kokkos::View<unsigned, MemorySpace> health; // Health bits, set by the kernels
    Kokkos::View<int, MemorySpace> stale_step;  // StepGate's
    Kokkos::View<int, PinnedSpace> notice;      // the same where the host sees it, a little later
    int step = 0;                               // drifts launched since take_stale
    int look_interval = 1;                      // steps between two looks at the notice; no bit depends on it
    Integrator();

    StepGate gate() const { return {stale_step.data(), step}; }
};

/// Gathers contact and wall forces in fixed order, adds gravity, applied and fluid forces, stores the sum and
/// gives the second half of the kick: velocities are then those of the positions' time.
void kick(Integrator const&, StepSettings const&, Particles const&, ContactList const&, WallForceRows const&);

/// First half of the next kick from the stored forces, then the move. Closes the gate if a grain has moved too far.
void drift(Integrator&, StepSettings const&, Particles const&, ContactList const&);

/// kick and drift in one kernel; leaves particles.force as it was. With a pass: of its grains alone.
void kick_and_drift(Integrator&, StepSettings const&, Particles const&, ContactList const&, WallForceRows const&,
                    ContactPass const&);
inline void kick_and_drift(Integrator& integrator, StepSettings const& settings, Particles const& particles,
                           ContactList const& contacts, WallForceRows const& walls)
{
    kick_and_drift(integrator, settings, particles, contacts, walls, whole_step(contacts));
}

/// Health bits so far. Waits for the device.
unsigned read_health(Integrator const&);

/// Whether the device has said that the list is stale; it may be about to. Waits for nothing.
bool says_stale(Integrator const&);

/// Waits for the steps that were launched and opens the gate. Below 0: all were made and the list holds. Else the list is
/// stale, and so many steps after the last drift that was made (each the kernels between two drifts) did nothing.
int take_stale(Integrator&);

} // namespace arenite
