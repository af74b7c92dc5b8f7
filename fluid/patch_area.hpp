// SPDX-License-Identifier: MIT
// Exact area of a disc or a rectangle on a rectangular cell face, so that a hole has its true area
// whatever the grid: the shares of all faces sum to pi d^2 / 4 by telescoping.
#pragma once

#include "core/real.hpp"

namespace arenite {

/// Rectangle [lower, upper] in the two directions along a face, m.
struct FaceRectangle {
    Real lower[2], upper[2];
};

/// Area of the unit disc in x' <= x, y' <= y: the integral over x' of the height below y, in closed form.
inline Real unit_disc_quadrant_area(Real x, Real y)
{
    x = Kokkos::fmin(Kokkos::fmax(x, Real(-1)), Real(1));
    y = Kokkos::fmin(Kokkos::fmax(y, Real(-1)), Real(1));
    auto const half_area = [](Real t) { // integral of sqrt(1 - t^2)
        return Real(0.5) * (Kokkos::asin(t) + t * Kokkos::sqrt(Kokkos::fmax(1 - t * t, Real(0))));
    };
    Real const c = Kokkos::sqrt(Kokkos::fmax(1 - y * y, Real(0))); // the line y cuts the circle at -c and c
    Real const middle = Kokkos::fmin(Kokkos::fmax(x, -c), c);
    Real area = y * (middle + c) + half_area(middle) - half_area(-c); // between -c and c: height y + s
    if (y > 0) {                                                      // beyond: the whole chord 2 s
        area += 2 * (half_area(Kokkos::fmin(x, -c)) - half_area(-1));
        area += 2 * (half_area(Kokkos::fmax(x, c)) - half_area(c));
    }
    return area;
}

/// Area of the disc inside the rectangle, m2.
inline Real disc_area_in_rectangle(Real const (&center)[2], Real radius, FaceRectangle const& face)
{
    Real x[2], y[2];
    for (int side = 0; side < 2; ++side) {
        x[side] = ((side == 0 ? face.lower[0] : face.upper[0]) - center[0]) / radius;
        y[side] = ((side == 0 ? face.lower[1] : face.upper[1]) - center[1]) / radius;
    }
    Real const area = (unit_disc_quadrant_area(x[1], y[1]) - unit_disc_quadrant_area(x[0], y[1])) -
                      (unit_disc_quadrant_area(x[1], y[0]) - unit_disc_quadrant_area(x[0], y[0]));
    return area * radius * radius;
}

/// Area that two rectangles share, m2.
inline Real rectangle_area_in_rectangle(FaceRectangle const& a, FaceRectangle const& b)
{
    Real area = 1;
    for (int d = 0; d < 2; ++d)
        area *= Kokkos::fmax(Kokkos::fmin(a.upper[d], b.upper[d]) - Kokkos::fmax(a.lower[d], b.lower[d]), Real(0));
    return area;
}

} // namespace arenite
