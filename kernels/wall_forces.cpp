// SPDX-License-Identifier: MIT
#include "kernels/wall_forces.hpp"

#include "kernels/evaluate_forces.hpp"

namespace arenite {
namespace {

template <class Law>
void launch_wall_kernel(Law const& law, Particles const& particles, PeriodicBox const& box, Walls const& walls,
                        WallContacts const& contacts, Real dt, StepGate const& gate)
{
    constexpr int each = WallContactEvaluation<Law>::groups_at_once;
    for_each_turn("evaluate_wall_contacts", (contacts.groups + each - 1) / each,
                  WallContactEvaluation<Law>{law, contacts, walls.views, particles.position, particles.velocity,
                                             particles.spin, particles.material, box, dt, gate});
}

} // namespace

void evaluate_wall_contacts(AnyContactLaw const& law, Particles const& particles, PeriodicBox const& box, Walls const& walls,
                            WallContacts const& contacts, Real dt, StepGate const& gate)
{
    if (contacts.groups == 0) return;
    std::visit([&](auto const& chosen) { launch_wall_kernel(chosen, particles, box, walls, contacts, dt, gate); }, law);
}

} // namespace arenite
