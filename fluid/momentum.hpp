// SPDX-License-Identifier: MIT
// The first half of a fluid step: velocities from the momentum equation with the old pressure.
#pragma once

#include "fluid/boundary.hpp"
#include "fluid/flow_solver.hpp"

namespace arenite {

/// Sets flow.velocity to the predicted one; false when the viscous solve did not converge.
bool predict_velocity(Flow& flow, FlowBoundary const& boundary, FlowSolver& solver, TimeDerivative const& time);

/// n u on the boundary faces becomes what the velocity patches (and walls) prescribe.
void set_boundary_velocity(Flow const& flow, FlowBoundary const& boundary);

/// Stores -grad p + div tau as the finished step has felt it: the force per volume that closes the momentum
/// balance of each face's control volume,
///   n F = d(rho n u)/dt + div(rho n u u) - n body_force + B u - b,
/// so that the grains' share (1 - n) F and the fluid's n F add up to F to rounding, whatever the tolerances
/// of the solvers. At boundary faces convection is left out; where the velocity is prescribed F is the
/// force that holds it against drag and body force.
void evaluate_face_force(Flow const& flow, FlowBoundary const& boundary, FlowSolver const& solver,
                         TimeDerivative const& time);

} // namespace arenite
