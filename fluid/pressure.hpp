// SPDX-License-Identifier: MIT
// The second half of a fluid step: the pressure that makes n u obey continuity, and the correction.
//
//   -div( n m grad phi ) = -(dn/dt + div(n u*)),   u = u* - m grad phi,   m = n / (rho a n + B)
//   p = p_old + phi - mu / n * (dn/dt + div(n u*))
//
// m is the predictor's own mobility, drag included. The last term (the rotational form: Timmermans, Minev &
// van de Vosse 1996; Guermond & Shen 2004) removes the artificial pressure boundary layer and makes a
// viscous flow reach its steady state in a few steps of any length.
#pragma once

#include "fluid/flow_solver.hpp"

namespace arenite {

/// phi into solver.pressure_system.solution, [cell]. Throws SimulationError when
/// a closed box is asked to take in or give up fluid.
KrylovReport solve_pressure(Flow const& flow, FlowBoundary const& boundary, FlowSolver& solver, TimeDerivative const& time);

void correct_velocity(Flow const& flow, FlowBoundary const& boundary, FlowSolver const& solver, TimeDerivative const& time);

} // namespace arenite
