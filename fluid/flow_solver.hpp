// SPDX-License-Identifier: MIT
// What the fluid's time step owns besides the flow: the older time levels (state: a restart needs them),
// the work arrays and the levels of the pressure solver, all made once.
//
// Time: viscosity, drag and pressure implicit, convection and the viscous coupling between components at
// the extrapolated velocity u + omega (u - u_previous), omega = dt / dt_previous (0 in a first step).
//   bdf2   second order for a porosity constant in time; for a fluid alone.
//   euler  first order; with grains, since a step's change of momentum is then exactly dt times the forces,
//          which is what the grains receive, and a drag that jumps from step to step cannot ring.
#pragma once

#include "core/reproducible_sum.hpp"
#include "fluid/boundary.hpp"
#include "fluid/conjugate_gradients.hpp"
#include "fluid/flow.hpp"
#include "fluid/multigrid.hpp"

namespace arenite {

enum class TimeScheme { euler, bdf2 };

/// d(m)/dt at the new time = now * m - old * m_old + older * m_older, 1/s.
struct TimeDerivative {
    Real now = 0, old = 0, older = 0;
    Real extrapolation = 0; // omega
    Real dt = 0;            // s
};

struct FlowSolver {
    TimeScheme scheme = TimeScheme::euler;
    ConvectionScheme convection = ConvectionScheme::limited;
    KrylovLimits pressure_limits, velocity_limits;

    // State beside the flow's own: for_each_state_field.
    FaceField previous_velocity; // [face] one step before flow.velocity, m/s
    FieldView porosity_oldest;   // [cell] one step before flow.porosity_previous
    Real previous_time_step = 0; // s, 0 before the first step
    FaceField face_force;        // [face] -grad p + div tau that the last step used, Pa/m

    // Work.
    FaceField extrapolated;        // [face] velocity at the new time, extrapolated, m/s
    FaceField convective;          // [face] div(rho n u u), N/m3
    FaceField history;             // [face] old part of d(rho n u)/dt, N/m3
    FieldView continuity;          // [cell] dn/dt + div(n u) before the correction, 1/s
    KrylovVectors velocity_system; // [component][node]
    View1<Real> velocity_diagonal; // [component][node] inverse
    KrylovVectors pressure_system; // [cell]
    MultigridLevels levels;
    SumWorkspace sums;
};

FlowSolver make_flow_solver(FluidSettings const& settings, Flow const& flow);

TimeDerivative time_derivative(FlowSolver const& solver, Real dt);

/// f(name, view) for every field, f(name, Real&) for every number that a bit-exact restart needs.
template <class Function> void for_each_state_field(Flow& flow, FlowSolver& solver, Function const& f)
{
    static constexpr char const* axis_names[3] = {"x", "y", "z"};
    auto const faces = [&](char const* name, FieldView(&views)[3]) {
        for (int axis = 0; axis < 3; ++axis) f(std::string(name) + "_" + axis_names[axis], views[axis]);
    };
    faces("fluid_velocity", flow.velocity);
    f(std::string("fluid_pressure"), flow.pressure);
    f(std::string("porosity"), flow.porosity);
    f(std::string("porosity_previous"), flow.porosity_previous);
    f(std::string("porosity_oldest"), solver.porosity_oldest);
    faces("fluid_velocity_previous", solver.previous_velocity.component);
    faces("fluid_face_force", solver.face_force.component);
    f(std::string("fluid_previous_time_step"), solver.previous_time_step);
}

} // namespace arenite
