// SPDX-License-Identifier: MIT
// Difference and interpolation operators of the staggered grid, named by where their result lives.
// "x_face" reads as "the face normal to `axis`"; node is that face's, or the cell's, index.
//
// Adjoint pairs, which make the exchange of momentum with the grains exact: a cell field goes to the faces
// by mean_at_face (half from each side; the cell's own value at a boundary face, whose control volume is
// half a cell), and a face field comes to the cells by mean_at_cell, so that with the face volumes V_f
//   sum_f V_f mean_at_face(B)_f u_f = sum_c V B_c mean_at_cell(u)_c      for any B and u.
#pragma once

#include "fluid/flow.hpp"
#include "fluid/grid_loops.hpp"

namespace arenite {

/// Cell field at the face between the cells node - 1 and node. The halo holds a copy of the boundary cell.
KOKKOS_FORCEINLINE_FUNCTION Real mean_at_face(FieldView const& cell_field, int axis, Node const& face)
{
    return Real(0.5) * (at(cell_field, shifted(face, axis, -1)) + at(cell_field, face));
}

KOKKOS_FORCEINLINE_FUNCTION Real difference_at_face(FieldView const& cell_field, int axis, Node const& face, Real spacing)
{
    return (at(cell_field, face) - at(cell_field, shifted(face, axis, -1))) / spacing;
}

/// Component `axis` of a face field at a cell's centre.
KOKKOS_FORCEINLINE_FUNCTION Real mean_at_cell(FieldView const& face_field, int axis, Node const& cell)
{
    return Real(0.5) * (at(face_field, cell) + at(face_field, shifted(cell, axis, 1)));
}

/// Interstitial fluid velocity at a cell's centre, m/s.
KOKKOS_FORCEINLINE_FUNCTION Vec3 velocity_at_cell(Flow const& flow, Node const& cell)
{
    Vec3 velocity;
    for (int axis = 0; axis < 3; ++axis) velocity[axis] = mean_at_cell(flow.velocity[axis], axis, cell);
    return velocity;
}

/// Superficial velocity n u at a face, m/s.
KOKKOS_FORCEINLINE_FUNCTION Real flux_at_face(FieldView const& porosity, FieldView const& velocity, int axis,
                                              Node const& face)
{
    return mean_at_face(porosity, axis, face) * at(velocity, face);
}

/// div(n u) at a cell, 1/s.
KOKKOS_FORCEINLINE_FUNCTION Real divergence_at_cell(Flow const& flow, Node const& cell)
{
    Real sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        Real const lower = flux_at_face(flow.porosity, flow.velocity[axis], axis, cell);
        Real const upper = flux_at_face(flow.porosity, flow.velocity[axis], axis, shifted(cell, axis, 1));
        sum += (upper - lower) / flow.grid.spacing[axis];
    }
    return sum;
}

/// d2 u_e / (dx_component dx_e) summed over the other axes e, at a face inside the box: the part of
/// div(tau) that couples the components, before the factor mu (1 - 2/3).
KOKKOS_FORCEINLINE_FUNCTION Real mixed_derivative_at_face(Grid const& grid, FaceField const& velocity, int component,
                                                          Node const& face)
{
    Real sum = 0;
    for (int e = 0; e < 3; ++e) {
        if (e == component) continue;
        FieldView const& u = velocity.component[e];
        Node const before = shifted(face, component, -1);
        Real const upper = at(u, shifted(face, e, 1)) - at(u, shifted(before, e, 1));
        Real const lower = at(u, face) - at(u, before);
        sum += (upper - lower) / (grid.spacing[component] * grid.spacing[e]);
    }
    return sum;
}

} // namespace arenite
