// SPDX-License-Identifier: MIT
#include "kernels/contact_forces.hpp"

#include "kernels/evaluate_forces.hpp"

namespace arenite {
namespace {

template <class Law>
void launch_pair_kernel(Law const& law, Particles const& particles, PeriodicBox const& box, ContactList const& contacts,
                        ContactPass const& pass, Real dt, StepGate const& gate)
{
    static_assert(contact_block % lane_count == 0);
    auto const launch = [&](auto const& evaluation) {
        // 96 registers a thread; of its own the compiler takes 98, and a block fewer fits.
        for_each_turn<BoundedRangePolicy<128, 5>>("evaluate_contacts", evaluation.turns.count, evaluation);
    };
    auto const launch_for = [&]<BoxKind kind, bool several>() {
        launch(ContactEvaluation<Law, kind, several>{law, contacts, particles.position, particles.velocity, particles.spin,
                                                     particles.material, box, dt, gate, pass});
    };
    auto const launch_in = [&]<BoxKind kind>() {
        if (law.pairs.shared >= 0) launch_for.template operator()<kind, false>();
        else launch_for.template operator()<kind, true>();
    };
    if (box.deforms()) launch_in.template operator()<BoxKind::deforming>();
    else if (contacts.periodic) launch_in.template operator()<BoxKind::periodic>();
    else launch_in.template operator()<BoxKind::closed>();
}

} // namespace

void evaluate_contacts(AnyContactLaw const& law, Particles const& particles, PeriodicBox const& box,
                       ContactList const& contacts, ContactPass const& pass, Real dt, StepGate const& gate)
{
    std::visit([&](auto const& chosen) { launch_pair_kernel(chosen, particles, box, contacts, pass, dt, gate); }, law);
}

} // namespace arenite
