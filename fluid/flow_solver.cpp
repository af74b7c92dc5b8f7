// SPDX-License-Identifier: MIT
#include "fluid/flow_solver.hpp"

namespace arenite {

FlowSolver make_flow_solver(FluidSettings const& settings, Flow const& flow)
{
    Grid const& grid = flow.grid;
    FlowSolver solver;
    solver.scheme = flow.has_drag() ? TimeScheme::euler : TimeScheme::bdf2;
    solver.convection = settings.convection;
    solver.pressure_limits.relative = settings.pressure_tolerance;
    solver.velocity_limits.relative = 1e-8; // of the step's own change, so that a small step moves on too
    solver.velocity_limits.iterations = 5000;

    solver.previous_velocity = make_face_field(grid, "previous_velocity");
    for (int axis = 0; axis < 3; ++axis) Kokkos::deep_copy(solver.previous_velocity.component[axis], flow.velocity[axis]);
    solver.porosity_oldest = grid.make_field("porosity_oldest");
    Kokkos::deep_copy(solver.porosity_oldest, flow.porosity_previous);
    solver.face_force = make_face_field(grid, "face_force");
    solver.extrapolated = make_face_field(grid, "extrapolated_velocity");
    solver.convective = make_face_field(grid, "convective");
    solver.history = make_face_field(grid, "history");
    solver.continuity = grid.make_field("continuity");

    int const nodes = static_cast<int>(flow.pressure.size());
    solver.velocity_system = make_krylov_vectors(3 * nodes);
    solver.velocity_diagonal = View1<Real>("velocity_diagonal", 3 * nodes);
    solver.pressure_system = make_krylov_vectors(grid.cell_count());
    solver.levels = make_multigrid(grid);
    return solver;
}

TimeDerivative time_derivative(FlowSolver const& solver, Real dt)
{
    TimeDerivative d;
    d.dt = dt;
    d.extrapolation = solver.previous_time_step > 0 ? dt / solver.previous_time_step : 0;
    Real const w = solver.scheme == TimeScheme::bdf2 ? d.extrapolation : 0; // w = 0 is the implicit Euler step
    d.now = (1 + 2 * w) / (1 + w) / dt;
    d.old = (1 + w) / dt;
    d.older = w * w / (1 + w) / dt;
    return d;
}

} // namespace arenite
