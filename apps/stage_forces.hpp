// SPDX-License-Identifier: MIT
// The stage's contact laws, chosen once: what the step calls is bound to the law's own kernels here.
#pragma once

#include "apps/run_state.hpp"
#include "apps/stage_plan.hpp"
#include "kernels/energy_terms.hpp"

#include <functional>

namespace arenite {

struct StageForces {
    ContactNeeds needs, wall_needs;
    std::function<void(ContactPass const&, Real dt)> evaluate_pass; // forces between grains where they are now
    std::function<void(Real dt)> evaluate_walls;                    // those of walls on grains
    std::function<ContactReport()> report;                          // energies and counts of the grains' contacts
    std::function<Real()> wall_elastic; // J held by the grains' contacts with walls, as ContactReport's
    std::function<void()> form_bonds;   // of what touches now; empty where no pair bonds at the start

    // For a balance sheet, to `to` as reproducible_sums_to does it. adhered: the contacts' flags when they were last looked
    // at, brought up to date; origin: of the box's strain, m.
    std::function<void(Real* to, View1<std::uint8_t> const& adhered)> sum_pair_power; // contact_power's terms
    std::function<void(Real* to, View1<std::uint8_t> const& adhered, Vec3 const& origin)> sum_wall_power;
    std::function<void(Real* to)> sum_wall_work; // W of moving walls on the grains: `walls` of those alone
    std::function<StoredEnergy()> stored;        // of all contacts, walls included; waits
};

/// Binds the laws of the planned stage to the state, which must outlive the result. friction below 0: the
/// materials' own, otherwise that of every pair of grains.
StageForces make_stage_forces(PlannedStage const& planned, Real friction, RunState& state);

/// Forces of grains and walls where everything is now.
inline void evaluate_all(StageForces const& forces, RunState const& state, Real dt)
{
    forces.evaluate_pass(whole_step(state.contacts), dt);
    forces.evaluate_walls(dt);
}

} // namespace arenite
