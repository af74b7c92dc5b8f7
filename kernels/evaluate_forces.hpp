// SPDX-License-Identifier: MIT
// Forces of contacts where everything is now, under a law that was chosen outside the step. Their kernels take a compiler
// long, so that they have a source each, and whoever wants forces includes this.
#pragma once

#include "core/particles.hpp"
#include "core/walls.hpp"
#include "kernels/contact/contact_laws.hpp"
#include "kernels/contact_passes.hpp"
#include "kernels/step_gate.hpp"
#include "kernels/wall_contacts.hpp"

namespace arenite {

/// Between grains: writes forces, flags and what contacts remember into the list. dt [s]: since the last evaluation; 0
/// leaves springs as they are. Nothing happens once the gate is closed. With a pass: its contacts alone.
void evaluate_contacts(AnyContactLaw const& law, Particles const& particles, PeriodicBox const& box,
                       ContactList const& contacts, ContactPass const& pass, Real dt, StepGate const& gate = {});
inline void evaluate_contacts(AnyContactLaw const& law, Particles const& particles, PeriodicBox const& box,
                              ContactList const& contacts, Real dt, StepGate const& gate = {})
{
    evaluate_contacts(law, particles, box, contacts, whole_step(contacts), dt, gate);
}

/// Of walls on grains, likewise.
void evaluate_wall_contacts(AnyContactLaw const& law, Particles const& particles, PeriodicBox const& box, Walls const& walls,
                            WallContacts const& contacts, Real dt, StepGate const& gate = {});

} // namespace arenite
