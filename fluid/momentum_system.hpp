// SPDX-License-Identifier: MIT
// The implicit momentum equation, one row for each face whose velocity is free, divided by the face's
// porosity n and multiplied by a weight W (row_weight: the control volume in cells, 1 or 1/2 at an open boundary
// face, times 3/4 for each wall beside it):
//
//   W (rho a + B/n) / open * u - W mu (4/3 d2u/dx_d2 + sum of d2u/dx_e2) = right-hand side
//
// with a = TimeDerivative::now, d the component's own axis, e the other two. The slope at a wall is that of the
// parabola through the wall and the two nodes next to it (wall_scale). Divided by n the matrix is
// symmetric whatever the porosity; the components couple only through the right-hand side. `open` is the
// share of a boundary face that a pressure patch covers: the fluid moves through that share only, and u is
// the mean over the face.
#pragma once

#include "fluid/boundary.hpp"
#include "fluid/flow.hpp"
#include "fluid/flow_solver.hpp"
#include "fluid/operators.hpp"

namespace arenite {

struct MomentumSystem { // captured by kernels, by value
    Flow flow;
    FlowBoundary boundary;
    TimeDerivative time;
};

KOKKOS_FORCEINLINE_FUNCTION Real drag_at_face(Flow const& flow, int component, Node const& face)
{
    return flow.has_drag() ? mean_at_face(flow.drag, component, face) : Real(0);
}

KOKKOS_FORCEINLINE_FUNCTION Real drag_velocity_at_face(Flow const& flow, int component, Node const& face)
{
    return flow.has_drag() ? mean_at_face(flow.drag_velocity[component], component, face) : Real(0);
}

/// Factor of u in d(rho n u)/dt + B u, N s/m4; over n it is the row's own coefficient.
KOKKOS_FORCEINLINE_FUNCTION Real inertia_and_drag(MomentumSystem const& s, int component, Node const& face)
{
    Real const n = mean_at_face(s.flow.porosity, component, face);
    return s.time.now * s.flow.density * n + drag_at_face(s.flow, component, face);
}

/// Velocity that a change of the pressure gradient makes at a face, m/s per Pa/m. The same number stands in
/// the predictor, the pressure's matrix and the correction, so that a steady state knows no time step.
KOKKOS_INLINE_FUNCTION Real mobility_at_face(MomentumSystem const& s, int component, Node const& face)
{
    Real const n = mean_at_face(s.flow.porosity, component, face);
    return open_share(s.flow.grid, s.boundary, component, face) * n / inertia_and_drag(s, component, face);
}

/// Superficial velocity that a velocity patch prescribes on a boundary face; 0 inside.
KOKKOS_INLINE_FUNCTION Real prescribed_flux(MomentumSystem const& s, int component, Node const& face)
{
    int const side = boundary_side(s.flow.grid, component, face);
    return side == 0 ? Real(0) : boundary_face(s.boundary, component, side, face).flux;
}

/// Pressure gradient at a face, Pa/m; at an open boundary face over the half cell to the patch.
KOKKOS_INLINE_FUNCTION Real pressure_gradient_at_face(MomentumSystem const& s, int component, Node const& face)
{
    Real const h = s.flow.grid.spacing[component];
    int const side = boundary_side(s.flow.grid, component, face);
    if (side == 0) return difference_at_face(s.flow.pressure, component, face, h);
    Node const cell = side < 0 ? face : shifted(face, component, -1);
    return side * (boundary_face(s.boundary, component, side, face).pressure - at(s.flow.pressure, cell)) / (h / 2);
}

/// Whether the row lies next to one of two ends of `axis`, a transverse one.
KOKKOS_FORCEINLINE_FUNCTION bool beside_end(Grid const& grid, int axis, Node const& face)
{
    int const index = face[axis] - Grid::halo, last = grid.cells[axis] - 1;
    return (index == 0 || index == last) && !grid.periodic[axis] && last > 0;
}

/// Whether any wall can weigh on the row; most rows lie inside, and their loops skip the question.
KOKKOS_FORCEINLINE_FUNCTION bool beside_wall(Grid const& grid, int component, Node const& face)
{
    return beside_end(grid, first_transverse(component), face) || beside_end(grid, second_transverse(component), face);
}

/// Weight of a row beside an end of a transverse axis: 3/4 where the wall there holds the fluid, 1 where it is free.
/// The parabola's slope over h, stick (9 u1 - u2 - 8 u_wall)/3, gives u2 the coefficient 1 + stick/3; the weight
/// makes that 1 again, which is what u2's row has for u1.
KOKKOS_FORCEINLINE_FUNCTION Real wall_scale(MomentumSystem const& s, int component, int axis, Node const& face)
{
    if (!beside_end(s.flow.grid, axis, face)) return 1;
    int const side = face[axis] == Grid::halo ? -1 : 1;
    return 1 / (1 + edge_condition(s.flow.grid, s.boundary, axis, side, component, face, 1).stick / 3);
}

/// Weight of a row, W: its control volume in cells times wall_scale of both transverse axes.
KOKKOS_FORCEINLINE_FUNCTION Real row_weight(MomentumSystem const& s, int component, Node const& face)
{
    Real const weight = face_weight(s.flow.grid, s.boundary, component, face);
    if (!beside_wall(s.flow.grid, component, face)) return weight;
    return weight * wall_scale(s, component, first_transverse(component), face) *
           wall_scale(s, component, second_transverse(component), face);
}

/// wall_scale of the axes other than `axis`, mean of the rows at both ends of a link along it: symmetric also where
/// a wall's hold changes along the link.
KOKKOS_FORCEINLINE_FUNCTION Real link_scale(MomentumSystem const& s, int component, int axis, Node const& from,
                                            Node const& to)
{
    Real scale = 1;
    for (int other = 0; other < 3; ++other) {
        if (other == axis || other == component || !beside_end(s.flow.grid, other, from)) continue; // `to`: the same layer
        scale *= Real(0.5) * (wall_scale(s, component, other, from) + wall_scale(s, component, other, to));
    }
    return scale;
}

KOKKOS_FORCEINLINE_FUNCTION Real scale_of_link(MomentumSystem const& s, int component, int axis, Node const& face, int by,
                                               bool beside)
{
    return beside ? link_scale(s, component, axis, face, neighbour(s.flow.grid, face, axis, by)) : Real(1);
}

/// Coefficient of both neighbours along an axis of a row that is clear of boundaries, Pa s/m2.
KOKKOS_FORCEINLINE_FUNCTION Real viscous_coefficient(MomentumSystem const& s, int component, int axis)
{
    Real const per_square = s.flow.viscosity / (s.flow.grid.spacing[axis] * s.flow.grid.spacing[axis]);
    return axis == component ? Real(4) / 3 * per_square : per_square;
}

/// What viscosity does along one axis, as coefficients of the two neighbours and of the row itself.
struct ViscousLink {
    Real coefficient[2] = {0, 0}; // of (neighbour - u), lower and upper, Pa s/m2
    Real wall[2] = {0, 0};        // of (wall velocity - u)
    Real wall_source[2] = {0, 0}; // wall * wall velocity, Pa/m
};

KOKKOS_FORCEINLINE_FUNCTION ViscousLink viscous_link(MomentumSystem const& s, int component, int axis, Node const& face,
                                                     bool beside)
{
    Grid const& grid = s.flow.grid;
    Real const coefficient = viscous_coefficient(s, component, axis);
    int const index = face[axis] - Grid::halo;
    ViscousLink link;
    if (axis == component) { // through the centres of the two cells; none beyond a boundary: free of stress
        int const side = boundary_side(grid, component, face);
        for (int upper = 0; upper < 2; ++upper)
            if (side != (upper ? 1 : -1))
                link.coefficient[upper] = coefficient * scale_of_link(s, component, axis, face, upper ? 1 : -1, beside);
        return link;
    }
    Real const weight = face_weight(grid, s.boundary, component, face);
    for (int upper = 0; upper < 2; ++upper) {
        bool const at_boundary = !grid.periodic[axis] && index == (upper ? grid.cells[axis] - 1 : 0);
        if (!at_boundary) {
            link.coefficient[upper] = weight * coefficient * scale_of_link(s, component, axis, face, upper ? 1 : -1, beside);
            continue;
        }
        Real const n = mean_at_face(s.flow.porosity, component, face);
        EdgeCondition const edge = edge_condition(grid, s.boundary, axis, upper ? 1 : -1, component, face, n);
        // A single cell between two walls has no second node: the straight slope over half a cell.
        Real const slope = grid.cells[axis] == 1 ? Real(2) : Real(8) / 3 * wall_scale(s, component, axis, face);
        Real const other = link_scale(s, component, axis, face, face);
        link.wall[upper] = weight * slope * other * coefficient * edge.stick;
        link.wall_source[upper] = weight * slope * other * coefficient * edge.stick_velocity;
    }
    return link;
}

/// Whether the row is clear of all boundaries by a cell, as most are: its weight is 1, and nothing about its
/// links need be asked.
KOKKOS_FORCEINLINE_FUNCTION bool is_clear(Grid const& grid, Node const& face)
{
    for (int axis = 0; axis < 3; ++axis) {
        int const index = face[axis] - Grid::halo;
        if (index < 1 || index > grid.cells[axis] - 2) return false;
    }
    return true;
}

/// W mu (4/3 d2u/dx_d2 + ...) of a vector; `source` 1 with the walls' velocities, 0 for the matrix alone.
KOKKOS_FORCEINLINE_FUNCTION Real diffusion_at_face(MomentumSystem const& s, FieldView const& u, int component,
                                                   Node const& face, Real source)
{
    Real const here = at(u, face);
    Real sum = 0;
    if (is_clear(s.flow.grid, face)) {
        for (int axis = 0; axis < 3; ++axis) {
            Real const coefficient = viscous_coefficient(s, component, axis);
            for (int by = -1; by <= 1; by += 2) sum += coefficient * (at(u, shifted(face, axis, by)) - here);
        }
        return sum;
    }
    bool const beside = beside_wall(s.flow.grid, component, face);
    for (int axis = 0; axis < 3; ++axis) {
        ViscousLink const link = viscous_link(s, component, axis, face, beside);
        for (int upper = 0; upper < 2; ++upper) {
            if (link.coefficient[upper] > 0)
                sum += link.coefficient[upper] * (at(u, neighbour(s.flow.grid, face, axis, upper ? 1 : -1)) - here);
            sum += source * link.wall_source[upper] - link.wall[upper] * here;
        }
    }
    return sum;
}

/// Diagonal of the row, Pa s/m2.
KOKKOS_INLINE_FUNCTION Real momentum_diagonal(MomentumSystem const& s, int component, Node const& face)
{
    Real const n = mean_at_face(s.flow.porosity, component, face);
    Real sum = row_weight(s, component, face) * inertia_and_drag(s, component, face) /
               (n * open_share(s.flow.grid, s.boundary, component, face));
    if (is_clear(s.flow.grid, face)) {
        for (int axis = 0; axis < 3; ++axis)
            for (int upper = 0; upper < 2; ++upper) sum += viscous_coefficient(s, component, axis);
        return sum;
    }
    bool const beside = beside_wall(s.flow.grid, component, face);
    for (int axis = 0; axis < 3; ++axis) {
        bool const self = s.flow.grid.periodic[axis] && s.flow.grid.cells[axis] == 1;
        ViscousLink const link = viscous_link(s, component, axis, face, beside);
        for (int upper = 0; upper < 2; ++upper) sum += (self ? 0 : link.coefficient[upper]) + link.wall[upper];
    }
    return sum;
}

} // namespace arenite
