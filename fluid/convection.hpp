// SPDX-License-Identifier: MIT
// Convective transport of momentum, div(rho n u u), in conservative form: what leaves one control volume
// enters the next. The carried velocity is the mean of the two sides (central), the upstream one (upwind)
// or upstream plus van Leer's limited slope (limited: second order, no new extrema).
#pragma once

#include "fluid/boundary.hpp"
#include "fluid/operators.hpp"

namespace arenite {

/// Value half way between centre and downstream.
KOKKOS_FORCEINLINE_FUNCTION Real carried_value(ConvectionScheme scheme, Real upstream, Real centre, Real downstream)
{
    if (scheme == ConvectionScheme::central) return Real(0.5) * (centre + downstream);
    if (scheme == ConvectionScheme::upwind) return centre;
    Real const behind = centre - upstream, ahead = downstream - centre;
    return behind * ahead > 0 ? centre + behind * ahead / (behind + ahead) : centre;
}

/// n u_axis at the side of a component's control volume that lies between `face` and its neighbour above.
KOKKOS_FORCEINLINE_FUNCTION Real carrying_flux(FieldView const& porosity, FaceField const& u, int component, int axis,
                                               Node const& face)
{
    if (axis == component)
        return Real(0.5) * (flux_at_face(porosity, u.component[axis], axis, face) +
                            flux_at_face(porosity, u.component[axis], axis, shifted(face, axis, 1)));
    Node const edge = shifted(face, axis, 1);
    return Real(0.5) * (flux_at_face(porosity, u.component[axis], axis, edge) +
                        flux_at_face(porosity, u.component[axis], axis, shifted(edge, component, -1)));
}

/// Momentum flux over rho through that side, m2/s2.
KOKKOS_FORCEINLINE_FUNCTION Real momentum_flux(ConvectionScheme scheme, FieldView const& porosity, FaceField const& u,
                                               int component, int axis, Node const& face, bool on_boundary)
{
    FieldView const& carried = u.component[component];
    Real const flux = carrying_flux(porosity, u, component, axis, face);
    Real const below = at(carried, face), above = at(carried, shifted(face, axis, 1));
    if (on_boundary) return flux * Real(0.5) * (below + above); // the halo's mirror: the boundary's own value
    Real const value = flux > 0 ? carried_value(scheme, at(carried, shifted(face, axis, -1)), below, above)
                                : carried_value(scheme, at(carried, shifted(face, axis, 2)), above, below);
    return flux * value;
}

/// div(n u u) for a component at a face inside the box, m/s2; u with filled halos.
KOKKOS_FORCEINLINE_FUNCTION Real convection_at_face(Grid const& grid, ConvectionScheme scheme, FieldView const& porosity,
                                                    FaceField const& u, int component, Node const& face)
{
    Real sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        bool const edges = axis != component && !grid.periodic[axis];
        int const index = face[axis] - Grid::halo;
        Real const upper = momentum_flux(scheme, porosity, u, component, axis, face, edges && index == grid.cells[axis] - 1);
        Real const lower = momentum_flux(scheme, porosity, u, component, axis, shifted(face, axis, -1), edges && index == 0);
        sum += (upper - lower) / grid.spacing[axis];
    }
    return sum;
}

} // namespace arenite
