// SPDX-License-Identifier: MIT
#include "fluid/pressure.hpp"

#include "core/error.hpp"
#include "fluid/momentum_system.hpp"

#include <fmt/format.h>

namespace arenite {
namespace {

/// n u through the two faces of a cell; a periodic upper face is the first one.
struct CellFluxes {
    Real lower, upper;
};

KOKKOS_INLINE_FUNCTION CellFluxes fluxes_of(Flow const& flow, int axis, Node const& cell)
{
    return {flux_at_face(flow.porosity, flow.velocity[axis], axis, cell),
            flux_at_face(flow.porosity, flow.velocity[axis], axis, neighbour(flow.grid, cell, axis, 1))};
}

void assemble_conductances(MomentumSystem const& system, MultigridLevel const& finest)
{
    for (int axis = 0; axis < 3; ++axis) {
        MomentumSystem const s = system;
        View1<Real> const conductance = finest.conductance[axis];
        Grid const grid = s.flow.grid;
        int const nx = grid.cells[0] + (axis == 0), ny = grid.cells[1] + (axis == 1);
        bool const self = grid.cells[axis] == 1 && grid.periodic[axis]; // a cell that is its own neighbour
        Kokkos::parallel_for(
            "assemble_conductances", RangePolicy(0, finest.face_count(axis)), KOKKOS_LAMBDA(int f) {
                Node const face{f % nx + Grid::halo, f / nx % ny + Grid::halo, f / nx / ny + Grid::halo};
                Real const distance = grid.spacing[axis] * (boundary_side(grid, axis, face) == 0 ? Real(1) : Real(0.5));
                Real const n = mean_at_face(s.flow.porosity, axis, face);
                conductance(f) = self ? 0 : n * mobility_at_face(s, axis, face) * grid.face_area(axis) / distance;
            });
    }
}

/// dn/dt + div(n u) into solver.continuity and the right-hand side, m3/s, into the residual.
void evaluate_continuity(Flow const& flow_now, FlowSolver const& solver, Real dt)
{
    Flow const flow = flow_now;
    FieldView const continuity = solver.continuity;
    View1<Real> const residual = solver.pressure_system.residual;
    for_each_cell(
        "evaluate_continuity", flow.grid, KOKKOS_LAMBDA(Node const& cell) {
            Real sum = (at(flow.porosity, cell) - at(flow.porosity_previous, cell)) / dt;
            for (int axis = 0; axis < 3; ++axis) {
                CellFluxes const flux = fluxes_of(flow, axis, cell);
                sum += (flux.upper - flux.lower) / flow.grid.spacing[axis];
            }
            at(continuity, cell) = sum;
            residual(cell_number(flow.grid, cell)) = -sum * flow.grid.cell_volume();
        });
}

struct Throughput {
    Real imbalance; // sum of the residuals, m3/s
    Real rounding;  // norm below which a residual is rounding, m3/s
};

Throughput measure_throughput(Flow const& flow_now, FlowSolver& solver, Real dt)
{
    Flow const flow = flow_now;
    View1<Real> const residual = solver.pressure_system.residual;
    Terms<2> const sums = reproducible_sums<2>(
        solver.sums, "measure_throughput", flow.grid.cell_count(), KOKKOS_LAMBDA(int c) {
            Node const cell = cell_of_number(flow.grid, c);
            Real passing =
                (at(flow.porosity, cell) + at(flow.porosity_previous, cell)) / dt * flow.grid.cell_volume() * Real(1e-2);
            for (int axis = 0; axis < 3; ++axis) {
                CellFluxes const flux = fluxes_of(flow, axis, cell);
                passing += (Kokkos::abs(flux.lower) + Kokkos::abs(flux.upper)) * flow.grid.face_area(axis);
            }
            return Terms<2>{residual(c), passing * passing};
        });
    constexpr Real few_ulp = 1e-15;
    return {sums[0], few_ulp * std::sqrt(sums[1])};
}

void add_constant(View1<Real> const& vector, Real constant)
{
    Kokkos::parallel_for(
        "add_constant", RangePolicy(0, vector.extent_int(0)), KOKKOS_LAMBDA(int c) { vector(c) += constant; });
}

/// A closed box takes no net volume: what is left is rounding, of the porosities and of what passes from cell to cell, and
/// is spread evenly.
void project_closed_box(Flow const& flow, FlowSolver& solver, Throughput const& throughput, Real dt)
{
    Real const imbalance = throughput.imbalance, cells = flow.grid.cell_count();
    constexpr Real of_porosities = 1e-9; // of the box per step; they are sums over many grains
    Real const rounding = of_porosities * cells * flow.grid.cell_volume() / dt + std::sqrt(cells) * throughput.rounding;
    if (!(std::abs(imbalance) <= rounding))
        throw SimulationError(fmt::format("fluid: the closed box would have to {} {:g} m3 of fluid in a step of {:g} s "
                                          "(its porosity changes or its inflow and outflow differ); it needs a "
                                          "pressure patch",
                                          imbalance > 0 ? "take in" : "give up", std::abs(imbalance) * dt, dt));
    add_constant(solver.pressure_system.residual, -imbalance / cells);
}

/// One number more in phi closes the mass of the whole box to rounding, whatever the solver's tolerance:
/// with openings the sum of the residuals over that of the boundary's conductances; else phi has no mean.
void close_mass(FlowBoundary const& boundary, FlowSolver& solver)
{
    KrylovVectors const& v = solver.pressure_system;
    int const cells = v.solution.extent_int(0);
    if (!boundary.has_pressure) {
        add_constant(v.solution, -reproducible_sum(solver.sums, v.solution) / cells);
        return;
    }
    Kokkos::deep_copy(ExecutionSpace(), v.direction, Real(1));
    apply_conductances(solver.levels[0], v.direction, v.image);
    Terms<2> const sums = reproducible_sums<2>(
        solver.sums, "close_mass", cells, KOKKOS_LAMBDA(int c) { return Terms<2>{v.residual(c), v.image(c)}; });
    add_constant(v.solution, sums[0] / sums[1]);
}

} // namespace

KrylovReport solve_pressure(Flow const& flow, FlowBoundary const& boundary, FlowSolver& solver, TimeDerivative const& time)
{
    Phase const phase("pressure solve");
    KrylovVectors const& v = solver.pressure_system;
    assemble_conductances({flow, boundary, time}, solver.levels[0]);
    update_multigrid(solver.levels);
    evaluate_continuity(flow, solver, time.dt);
    Throughput const throughput = measure_throughput(flow, solver, time.dt);
    if (!boundary.has_pressure) project_closed_box(flow, solver, throughput, time.dt);

    Kokkos::deep_copy(ExecutionSpace(), v.solution, Real(0));
    KrylovLimits limits = solver.pressure_limits;
    limits.absolute = throughput.rounding;
    auto const matrix = [&](View1<Real> const& x, View1<Real> const& y) { apply_conductances(solver.levels[0], x, y); };
    auto const cycle = [&](View1<Real> const& r, View1<Real> const& z) { multigrid_cycle(solver.levels, r, z); };
    KrylovReport const report = solve_by_conjugate_gradients(v, limits, solver.sums, matrix, cycle);
    close_mass(boundary, solver);
    return report;
}

void correct_velocity(Flow const& flow_now, FlowBoundary const& boundary, FlowSolver const& solver,
                      TimeDerivative const& time)
{
    Phase const phase("correction");
    MomentumSystem const s{flow_now, boundary, time};
    Grid const grid = flow_now.grid;
    View1<Real> const phi = solver.pressure_system.solution;
    for_each_face(
        "correct_velocity", grid, KOKKOS_LAMBDA(int component, Node const& face) {
            if (!(face_weight(grid, s.boundary, component, face) > 0)) return;
            int const side = boundary_side(grid, component, face);
            Real const above = side > 0 ? 0 : phi(cell_number(grid, face));
            Real const below = side < 0 ? 0 : phi(cell_number(grid, neighbour(grid, face, component, -1)));
            Real const distance = grid.spacing[component] * (side == 0 ? Real(1) : Real(0.5));
            at(s.flow.velocity[component], face) -= mobility_at_face(s, component, face) * (above - below) / distance;
        });
    FieldView const continuity = solver.continuity;
    for_each_cell(
        "correct_pressure", grid, KOKKOS_LAMBDA(Node const& cell) {
            at(s.flow.pressure, cell) +=
                phi(cell_number(grid, cell)) - s.flow.viscosity / at(s.flow.porosity, cell) * at(continuity, cell);
        });
}

} // namespace arenite
