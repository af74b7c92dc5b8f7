// SPDX-License-Identifier: MIT
// The uniform fluid grid. Cell (i, j, k) has its centre at lower + (i + 1/2, j + 1/2, k + 1/2) * spacing.
// Every field, at cells or at faces, is one FieldView of allocated() extents and is addressed with the
// halo added: cell (i, j, k) is field(i + halo, j + halo, k + halo); the x-face between cells i-1 and i
// has the index i, and so on for y and z. The halo carries boundary values, periodic images and, with
// ranks, neighbours.
#pragma once

#include "core/types.hpp"
#include "core/vec3.hpp"

#include <string>

namespace arenite {

struct Grid {
    static constexpr int halo = 2; // two, since the limited convection scheme reaches two cells upstream

    int cells[3] = {1, 1, 1};
    Vec3 lower;            // m
    Vec3 spacing{1, 1, 1}; // m
    bool periodic[3] = {false, false, false};

    KOKKOS_FUNCTION int cell_count() const { return cells[0] * cells[1] * cells[2]; }
    KOKKOS_FUNCTION Real cell_volume() const { return spacing.x * spacing.y * spacing.z; }
    KOKKOS_FUNCTION Real length(int axis) const { return cells[axis] * spacing[axis]; }
    KOKKOS_FUNCTION Vec3 upper() const { return {lower.x + length(0), lower.y + length(1), lower.z + length(2)}; }
    KOKKOS_FUNCTION Real face_area(int axis) const { return cell_volume() / spacing[axis]; }
    KOKKOS_FUNCTION Vec3 center(int i, int j, int k) const
    {
        return {lower.x + (i + Real(0.5)) * spacing.x, lower.y + (j + Real(0.5)) * spacing.y,
                lower.z + (k + Real(0.5)) * spacing.z};
    }
    /// Extent of a field along an axis: the cells, one more for the last face, and the halo on both sides.
    KOKKOS_FUNCTION int allocated(int axis) const { return cells[axis] + 1 + 2 * halo; }

    FieldView make_field(char const* label) const
    {
        return FieldView(std::string(label), allocated(0), allocated(1), allocated(2));
    }
};

} // namespace arenite
