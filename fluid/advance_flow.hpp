// SPDX-License-Identifier: MIT
// One step of the fluid. Before it the caller sets flow.porosity (and, with grains, drag and drag_velocity);
// flow.porosity_previous is the porosity at the end of the step before. After it porosity_previous equals
// porosity, halos are filled and solver.face_force holds what the grains receive (flow_balance.hpp).
#pragma once

#include "fluid/boundary.hpp"
#include "fluid/flow.hpp"
#include "fluid/flow_solver.hpp"
#include "fluid/halos.hpp"

namespace arenite {

/// Pa/m: the settings' own and, where they want it, the weight of the fluid.
Vec3 body_force(FluidSettings const& settings, Vec3 const& gravity);

/// A flow at rest or at the settings' initial velocity, of uniform porosity, in the box (settings.box is not looked at: a
/// wall may have cut it). Gravity enters the body force where the settings want it. Throws InputError.
Flow make_flow(FluidSettings const& settings, Region const& box, bool with_grains, Vec3 gravity);

FlowReport advance_flow(Flow& flow, FlowBoundary const& boundary, FlowSolver& solver, Real dt);

} // namespace arenite
