// SPDX-License-Identifier: MIT
// What every boundary face of the fluid box is: the share of it that is open at a pressure, the flux
// that is prescribed on it, and how much of it holds the fluid's tangential velocity. Patches are laid
// in order; a later one takes its share of the face from what lies below. On a face that is cut by the
// rims of two patches the two shares are taken as independent (exact where at most one rim cuts it).
#pragma once

#include "core/scene.hpp"
#include "fluid/grid_loops.hpp"

namespace arenite {

struct BoundaryFace {
    Real open = 0;       // share under pressure patches; the rest is closed or has a prescribed flux
    Real flux = 0;       // superficial velocity along the axis (not outward), mean over the face, m/s
    Real pressure = 0;   // of the open share, Pa
    Real stick = 1;      // share where the tangential velocity is prescribed; the rest is free of shear
    Vec3 wall_velocity;  // stick-weighted tangential velocity of walls, m/s
    Vec3 inlet_velocity; // stick-weighted tangential superficial velocity of velocity patches, m/s
};

/// [a][b]: cells along the two other axes, ascending.
using BoundaryFaceView = Kokkos::View<BoundaryFace**, Kokkos::LayoutLeft, MemorySpace>;

struct FlowBoundary {
    BoundaryFaceView faces[3][2]; // [axis][0 lower, 1 upper]; empty where the axis is periodic
    bool has_pressure = false;    // some face is open: the pressure's level is fixed
};

/// Which axes are periodic by the patches; throws InputError where one face of a pair is and the other not.
void set_periodic_axes(FluidSettings const& settings, Grid& grid);

/// Throws InputError for patches that make no sense and for prescribed fluxes that cannot balance.
FlowBoundary make_boundary(FluidSettings const& settings, Grid const& grid);

KOKKOS_INLINE_FUNCTION int first_transverse(int axis) { return axis == 0 ? 1 : 0; }
KOKKOS_INLINE_FUNCTION int second_transverse(int axis) { return axis == 2 ? 1 : 2; }

/// The condition on the face of this cell (or face node) on a boundary; side is -1 or 1.
KOKKOS_FORCEINLINE_FUNCTION BoundaryFace const& boundary_face(FlowBoundary const& boundary, int axis, int side,
                                                              Node const& cell)
{
    return boundary.faces[axis][side > 0](cell[first_transverse(axis)] - Grid::halo,
                                          cell[second_transverse(axis)] - Grid::halo);
}

/// Tangential condition on an edge: shear = stick * viscosity * (velocity - u) / (half a cell).
struct EdgeCondition {
    Real stick = 0;
    Real stick_velocity = 0; // stick * velocity, m/s
};

/// Condition that component `component`, living at `face`, meets at the boundary of another axis: the
/// mean of the two boundary faces that its control volume touches.
KOKKOS_INLINE_FUNCTION EdgeCondition edge_condition(Grid const& grid, FlowBoundary const& boundary, int axis, int side,
                                                    int component, Node const& face, Real porosity)
{
    EdgeCondition edge;
    int const n = grid.cells[component];
    for (int by = -1; by <= 0; ++by) {
        int cell = face[component] - Grid::halo + by;
        if (grid.periodic[component]) cell = ((cell % n) + n) % n;
        else cell = cell < 0 ? 0 : (cell >= n ? n - 1 : cell);
        Node touched = face;
        touched[component] = cell + Grid::halo;
        BoundaryFace const& condition = boundary_face(boundary, axis, side, touched);
        edge.stick += Real(0.5) * condition.stick;
        edge.stick_velocity +=
            Real(0.5) * (condition.wall_velocity[component] + condition.inlet_velocity[component] / porosity);
    }
    return edge;
}

/// Size of a face's control volume in cells: 1 inside, 1/2 at an open boundary face, 0 where the velocity
/// is prescribed.
KOKKOS_FORCEINLINE_FUNCTION Real face_weight(Grid const& grid, FlowBoundary const& boundary, int component, Node const& face)
{
    int const side = boundary_side(grid, component, face);
    if (side == 0) return 1;
    return boundary_face(boundary, component, side, face).open > 0 ? Real(0.5) : Real(0);
}

/// Share of the face through which the fluid can move freely.
KOKKOS_FORCEINLINE_FUNCTION Real open_share(Grid const& grid, FlowBoundary const& boundary, int component, Node const& face)
{
    int const side = boundary_side(grid, component, face);
    return side == 0 ? Real(1) : boundary_face(boundary, component, side, face).open;
}

} // namespace arenite
