// SPDX-License-Identifier: MIT
// The lid-driven cavity of unit size, density and lid speed: a run and its centre lines.
#pragma once

#include "core/real.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace arenite {

/// Along a centre line: the values at both walls and at the centres of the cells.
struct Profile {
    std::vector<Real> at, value;
    /// By a cubic through the four nearest points.
    Real operator()(Real s) const;
};

struct Cavity {
    Profile u, v;           // u over y at x = 1/2, v over x at y = 1/2
    bool converged = false; // every solve of the last step
    Real leak = 0;          // m3/s through the walls
    Real change = 0;        // largest of the velocities over the last unit of time
    int duration = 0;       // until then, lengths over lid speeds
    /// u_min, v_max, v_min
    std::array<Real, 3> extrema() const;
};

/// The steady states on grids of so many cells along an axis (even numbers, each twice the one before) with the central
/// scheme. The first starts from rest, the others from the flow of the grid before. A flow is steady when its
/// velocities change by less than `still` in a unit of time.
std::vector<Cavity> steady_cavities(Real reynolds, std::vector<int> const& cells, Real still);

struct CenterLinePoint {
    Real at, velocity;
};

template <std::size_t n> Real largest_error(Profile const& profile, CenterLinePoint const (&points)[n])
{
    Real worst = 0;
    for (CenterLinePoint const& point : points) worst = std::fmax(worst, std::fabs(profile(point.at) - point.velocity));
    return worst;
}

} // namespace arenite
