// SPDX-License-Identifier: MIT
// Loops over cells and faces of the staggered grid, and the index that they hand to their bodies.
#pragma once

#include "core/grid.hpp"

namespace arenite {

/// Index into a field, halo included, so that field(i, j, k) needs no shift.
struct Node {
    int i = 0, j = 0, k = 0;
    KOKKOS_FUNCTION constexpr int operator[](int axis) const { return axis == 0 ? i : (axis == 1 ? j : k); }
    KOKKOS_FUNCTION constexpr int& operator[](int axis) { return axis == 0 ? i : (axis == 1 ? j : k); }
};

KOKKOS_FORCEINLINE_FUNCTION Node shifted(Node node, int axis, int by)
{
    node[axis] += by;
    return node;
}

KOKKOS_FORCEINLINE_FUNCTION Real& at(FieldView const& field, Node const& node) { return field(node.i, node.j, node.k); }

/// A vector field on the faces: component[axis] lives at the faces normal to that axis.
struct FaceField {
    FieldView component[3];
};

/// Three cell-centred or face-centred fields of the grid's extents.
inline FaceField make_face_field(Grid const& grid, char const* label)
{
    return {{grid.make_field(label), grid.make_field(label), grid.make_field(label)}};
}

/// The neighbour `by` (-1 or 1) along an axis, a periodic axis wrapped. Not for boundary neighbours.
KOKKOS_FORCEINLINE_FUNCTION Node neighbour(Grid const& grid, Node node, int axis, int by)
{
    int const n = grid.cells[axis];
    int at = node[axis] - Grid::halo + by;
    if (grid.periodic[axis]) at = at < 0 ? at + n : (at >= n ? at - n : at);
    node[axis] = at + Grid::halo;
    return node;
}

/// Whether the node is a face of this component that stands for itself: the last face of a periodic
/// axis is the image of the first.
KOKKOS_FORCEINLINE_FUNCTION bool is_face(Grid const& grid, int component, Node const& node)
{
    for (int axis = 0; axis < 3; ++axis) {
        int const last = grid.cells[axis] - (axis == component && !grid.periodic[axis] ? 0 : 1);
        if (node[axis] - Grid::halo > last) return false;
    }
    return true;
}

/// -1 at the lower boundary of a component's own axis, 1 at the upper one, 0 inside or where it is periodic.
KOKKOS_FORCEINLINE_FUNCTION int boundary_side(Grid const& grid, int component, Node const& face)
{
    if (grid.periodic[component]) return 0;
    int const at = face[component] - Grid::halo;
    return at == 0 ? -1 : (at == grid.cells[component] ? 1 : 0);
}

namespace grid_loops_detail {

/// A block of nx ny ... nodes from `first` on in all directions.
template <class Body> struct OverNodes {
    Body body;
    int nx, ny, first;
    KOKKOS_FUNCTION void operator()(int c) const { body(Node{c % nx + first, c / nx % ny + first, c / nx / ny + first}); }
};

} // namespace grid_loops_detail

/// body(Node) for every cell, without the halo.
template <class Body> void for_each_cell(char const* label, Grid const& grid, Body const& body)
{
    Kokkos::parallel_for(label, RangePolicy(0, grid.cell_count()),
                         grid_loops_detail::OverNodes<Body>{body, grid.cells[0], grid.cells[1], Grid::halo});
}

/// Flat index of a cell without the halo, x fastest: the pressure solver's numbering.
KOKKOS_FORCEINLINE_FUNCTION int cell_number(Grid const& grid, Node const& cell)
{
    return cell.i - Grid::halo + grid.cells[0] * (cell.j - Grid::halo + grid.cells[1] * (cell.k - Grid::halo));
}

KOKKOS_FORCEINLINE_FUNCTION Node cell_of_number(Grid const& grid, int c)
{
    int const nx = grid.cells[0], ny = grid.cells[1];
    return {c % nx + Grid::halo, c / nx % ny + Grid::halo, c / nx / ny + Grid::halo};
}

KOKKOS_FORCEINLINE_FUNCTION int face_slots(Grid const& grid)
{
    return (grid.cells[0] + 1) * (grid.cells[1] + 1) * (grid.cells[2] + 1);
}

/// Node number c of the box that holds the faces of every component.
KOKKOS_FORCEINLINE_FUNCTION Node face_of_slot(Grid const& grid, int c)
{
    int const nx = grid.cells[0] + 1, ny = grid.cells[1] + 1;
    return {c % nx + Grid::halo, c / nx % ny + Grid::halo, c / nx / ny + Grid::halo};
}

namespace grid_loops_detail {

template <class Body> struct OverFaces {
    Body body;
    Grid grid;
    int slots;
    KOKKOS_FUNCTION void operator()(int f) const
    {
        int const component = f / slots;
        Node const node = face_of_slot(grid, f - component * slots);
        if (is_face(grid, component, node)) body(component, node);
    }
};

} // namespace grid_loops_detail

/// body(component, Node) for every face of the three components, boundary faces included.
template <class Body> void for_each_face(char const* label, Grid const& grid, Body const& body)
{
    int const slots = face_slots(grid);
    Kokkos::parallel_for(label, RangePolicy(0, 3 * slots), grid_loops_detail::OverFaces<Body>{body, grid, slots});
}

/// body(Node) for every node that a field holds, the halo included.
template <class Body> void for_each_node(char const* label, Grid const& grid, Body const& body)
{
    int const nx = grid.allocated(0), ny = grid.allocated(1), nz = grid.allocated(2);
    Kokkos::parallel_for(label, RangePolicy(0, nx * ny * nz), grid_loops_detail::OverNodes<Body>{body, nx, ny, 0});
}

} // namespace arenite
