// SPDX-License-Identifier: MIT
#include "apps/stage_forces.hpp"

#include "kernels/contact/contact_laws.hpp"
#include "kernels/contact_forces.hpp"
#include "kernels/wall_forces.hpp"

namespace arenite {
namespace {

template <class Law> ContactNeeds needs_of(Law const&) { return {Law::has_history, Law::adheres}; }

} // namespace

StageForces make_stage_forces(PlannedStage const& planned, Real friction, RunState& state)
{
    std::vector<PairConstants> pairs = planned.pairs;
    if (friction >= 0)
        for (PairConstants& pair : pairs) pair.friction = friction;
    AnyContactLaw const law = make_contact_law(pairs), wall_law = make_contact_law(planned.wall_pairs);

    StageForces forces;
    forces.needs = std::visit([](auto const& l) { return needs_of(l); }, law);
    forces.wall_needs = std::visit([](auto const& l) { return needs_of(l); }, wall_law);
    std::function<void(Real)> const on_grains = std::visit(
        [&state](auto const& l) -> std::function<void(Real)> {
            return [&state, l](Real dt) { evaluate_contacts(l, state.particles, state.box, state.contacts, dt); };
        },
        law);
    std::function<void(Real)> const on_walls = std::visit(
        [&state](auto const& l) -> std::function<void(Real)> {
            return [&state, l](Real dt) { evaluate_wall_contacts(l, state.particles, state.walls, state.wall_contacts, dt); };
        },
        wall_law);
    forces.evaluate = [&state, on_grains, on_walls](Real dt) {
        on_grains(dt);
        if (state.wall_contacts.count > 0) on_walls(dt);
    };
    forces.report = std::visit(
        [&state](auto const& l) -> std::function<ContactReport()> {
            return [&state, l] { return report_contacts(l, state.particles, state.box, state.contacts, state.sums); };
        },
        law);
    return forces;
}

} // namespace arenite
