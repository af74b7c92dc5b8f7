// SPDX-License-Identifier: MIT
// The grains' box. On a periodic axis a contact reaches across the faces: it stores the image code of its
// second grain, and the kernels look the shift up here. Images are ghosts in the search only: a contact
// between a grain and an image is evaluated once, keyed by the two ids, and its forces are equal and
// opposite to the last bit, which two evaluations at shifted positions would not be.
#pragma once

#include "core/vec3.hpp"

#include <cmath>

namespace arenite {

struct PeriodicBox {
    Vec3 lower, upper; // m
    bool periodic[3] = {false, false, false};
    Vec3 strain_rate{};   // 1/s: grains and images ride on the flow strain_rate * (x - strain_origin)
    Vec3 strain_origin{}; // m, where that flow rests

    static constexpr int no_image = 13; // code of the shift (0, 0, 0)

    KOKKOS_FUNCTION bool any_periodic() const { return periodic[0] || periodic[1] || periodic[2]; }
    KOKKOS_FUNCTION Vec3 size() const { return upper - lower; }
    KOKKOS_FUNCTION static int image_code(int sx, int sy, int sz) { return (sx + 1) + 3 * (sy + 1) + 9 * (sz + 1); }
    KOKKOS_FUNCTION static int image_step(int code, int axis)
    {
        return axis == 0 ? code % 3 - 1 : (axis == 1 ? code / 3 % 3 - 1 : code / 9 - 1);
    }
    /// What to add to a position to get its image, m.
    KOKKOS_FUNCTION Vec3 image_shift(int code) const
    {
        Vec3 const edge = size();
        return {image_step(code, 0) * edge.x, image_step(code, 1) * edge.y, image_step(code, 2) * edge.z};
    }
    /// Relative velocity that the box's deformation gives two points that are `offset` apart, m/s.
    template <class N> KOKKOS_FUNCTION Vector<N> stretch_velocity(Vector<N> const& offset) const
    {
        return {strain_rate.x * offset.x, strain_rate.y * offset.y, strain_rate.z * offset.z};
    }
    KOKKOS_FUNCTION bool deforms() const { return !(strain_rate == Vec3{}); }
};

/// Area [m2] that a box of edges `size` [m] shows along a unit axis.
inline Real cross_section(Vec3 const& size, Vec3 const& axis)
{
    return std::fabs(axis.x) * size.y * size.z + std::fabs(axis.y) * size.x * size.z + std::fabs(axis.z) * size.x * size.y;
}

} // namespace arenite
