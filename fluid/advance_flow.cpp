// SPDX-License-Identifier: MIT
#include "fluid/advance_flow.hpp"

#include "core/error.hpp"
#include "fluid/momentum.hpp"
#include "fluid/momentum_system.hpp"
#include "fluid/pressure.hpp"

#include <fmt/format.h>

#include <utility>

namespace arenite {
namespace {

Grid make_flow_grid(FluidSettings const& settings, Region const& box)
{
    Grid grid;
    grid.lower = box.lower;
    std::string faults;
    for (int axis = 0; axis < 3; ++axis) {
        grid.cells[axis] = settings.cells[axis];
        if (grid.cells[axis] < 1)
            faults += fmt::format("fluid.cells: {} along axis {}; must be at least 1\n", grid.cells[axis], axis);
        if (!(box.upper[axis] > box.lower[axis])) faults += fmt::format("fluid.box: no extent along axis {}\n", axis);
        grid.spacing[axis] = (box.upper[axis] - box.lower[axis]) / grid.cells[axis];
    }
    if (!faults.empty()) throw InputError(faults.substr(0, faults.size() - 1));
    return grid;
}

/// The pressure that goes with the initial velocity: a step without viscosity, of which only the pressure is
/// kept. A step from a pressure that does not balance the body force would leave an eddy of the splitting's
/// error behind, which only viscosity wears down.
void start_pressure(Flow& flow, FlowBoundary const& boundary, FlowSolver& solver, TimeDerivative const& time)
{
    Flow inviscid = flow; // the same fields
    inviscid.viscosity = 0;
    predict_velocity(inviscid, boundary, solver, time);
    solve_pressure(inviscid, boundary, solver, time);
    correct_velocity(inviscid, boundary, solver, time);
    for (int axis = 0; axis < 3; ++axis)
        Kokkos::deep_copy(ExecutionSpace(), flow.velocity[axis], solver.previous_velocity.component[axis]);
    fill_halos(flow, boundary);
}

/// The levels move on: new becomes old, old becomes oldest.
void shift_levels(Flow& flow, FlowSolver& solver, Real dt)
{
    std::swap(solver.porosity_oldest, flow.porosity_previous);
    Kokkos::deep_copy(ExecutionSpace(), flow.porosity_previous, flow.porosity);
    solver.previous_time_step = dt;
}

void report_extremes(Flow const& flow_now, Real dt, FlowReport& report)
{
    Flow const flow = flow_now;
    using Largest = Kokkos::Max<Real>; // exact in any order
    Kokkos::parallel_reduce(
        "report_extremes", RangePolicy(0, flow.grid.cell_count()),
        KOKKOS_LAMBDA(int c, Real& continuity, Real& courant) {
            Node const cell = cell_of_number(flow.grid, c);
            Real const change = (at(flow.porosity, cell) - at(flow.porosity_previous, cell));
            continuity = Kokkos::max(continuity, Kokkos::abs(change + dt * divergence_at_cell(flow, cell)));
            for (int axis = 0; axis < 3; ++axis)
                courant = Kokkos::max(courant, Kokkos::abs(at(flow.velocity[axis], cell)) * dt / flow.grid.spacing[axis]);
        },
        Largest(report.continuity_error), Largest(report.courant));
}

void report_boundary_flow(Flow const& flow_now, FlowSolver& solver, FlowReport& report)
{
    Flow const flow = flow_now;
    int const slots = face_slots(flow.grid);
    Terms<2> const sums = reproducible_sums<2>(
        solver.sums, "report_boundary_flow", 3 * slots, KOKKOS_LAMBDA(int f) {
            int const axis = f / slots;
            Node const face = face_of_slot(flow.grid, f - axis * slots);
            int const side = is_face(flow.grid, axis, face) ? boundary_side(flow.grid, axis, face) : 0;
            if (side == 0) return Terms<2>{0, 0};
            Real const outward =
                side * flux_at_face(flow.porosity, flow.velocity[axis], axis, face) * flow.grid.face_area(axis);
            return Terms<2>{Kokkos::max(-outward, Real(0)), Kokkos::max(outward, Real(0))};
        });
    report.inflow = sums[0];
    report.outflow = sums[1];
}

FlowReport report_step(Flow const& flow, FlowSolver& solver, Real dt)
{
    FlowReport report;
    report_extremes(flow, dt, report);
    report_boundary_flow(flow, solver, report);
    return report;
}

} // namespace

Vec3 body_force(FluidSettings const& settings, Vec3 const& gravity)
{
    return settings.gravity ? settings.body_force + settings.density * gravity : settings.body_force;
}

Flow make_flow(FluidSettings const& settings, Region const& box, bool with_grains, Vec3 gravity)
{
    Flow flow;
    flow.grid = make_flow_grid(settings, box);
    set_periodic_axes(settings, flow.grid);
    flow.density = settings.density;
    flow.viscosity = settings.viscosity;
    flow.body_force = body_force(settings, gravity);

    static constexpr char const* names[3] = {"fluid_velocity_x", "fluid_velocity_y", "fluid_velocity_z"};
    static constexpr char const* drag_names[3] = {"drag_velocity_x", "drag_velocity_y", "drag_velocity_z"};
    for (int axis = 0; axis < 3; ++axis) {
        flow.velocity[axis] = flow.grid.make_field(names[axis]);
        Kokkos::deep_copy(flow.velocity[axis], settings.initial_velocity[axis]);
        if (with_grains) flow.drag_velocity[axis] = flow.grid.make_field(drag_names[axis]);
    }
    if (with_grains) flow.drag = flow.grid.make_field("drag");
    flow.pressure = flow.grid.make_field("fluid_pressure");
    flow.porosity = flow.grid.make_field("porosity");
    flow.porosity_previous = flow.grid.make_field("porosity_previous");
    Kokkos::deep_copy(flow.pressure, settings.initial_pressure);
    Kokkos::deep_copy(flow.porosity, settings.porosity);
    Kokkos::deep_copy(flow.porosity_previous, settings.porosity);
    return flow;
}

FlowReport advance_flow(Flow& flow, FlowBoundary const& boundary, FlowSolver& solver, Real dt)
{
    ARENITE_REQUIRE(dt > 0, "a fluid step needs a positive length");
    TimeDerivative const time = time_derivative(solver, dt);
    fill_halos(flow, boundary);
    if (!(solver.previous_time_step > 0)) start_pressure(flow, boundary, solver, time);
    bool const predicted = predict_velocity(flow, boundary, solver, time);
    KrylovReport const pressure = solve_pressure(flow, boundary, solver, time);
    correct_velocity(flow, boundary, solver, time);
    evaluate_face_force(flow, boundary, solver, time);
    fill_halos(flow, boundary);

    FlowReport report = report_step(flow, solver, dt);
    report.pressure_iterations = pressure.iterations;
    report.pressure_residual = pressure.residual;
    report.velocity_converged = predicted;
    report.pressure_converged = pressure.converged;
    shift_levels(flow, solver, dt);
    return report;
}

} // namespace arenite
