// SPDX-License-Identifier: MIT
#include "apps/verify/jkr_reference.hpp"

#include <cmath>

namespace arenite {

long double reference_root(long double scaled_overlap)
{
    long double low = std::cbrt(0.5L), high = 2 + std::sqrt(std::sqrt(std::fabs(scaled_overlap) + 16));
    for (int n = 0; n < 80; ++n) {
        long double const middle = (low + high) / 2, square = middle * middle;
        (square * square - 2 * middle < scaled_overlap ? low : high) = middle;
    }
    return (low + high) / 2;
}

long double reference_force(long double scaled_overlap)
{
    long double const y = reference_root(scaled_overlap), cube = y * y * y;
    return (4.0L / 3 * cube - 4) * cube / 3;
}

JkrPoints jkr_points_of(PairConstants const& pair, Real effective_radius)
{
    long double const pi = 3.14159265358979323846264338327950288L;
    long double const gamma = pair.surface_energy, radius = effective_radius, modulus = pair.effective_youngs_modulus;
    long double const length = std::cbrt(pi * pi * gamma * gamma * radius / (modulus * modulus));
    long double const unit = pi * gamma * radius;
    long double const peel =
        std::cbrt(gamma * gamma * gamma * gamma * gamma * radius * radius * radius * radius / (modulus * modulus));
    JkrPoints points;
    points.length = static_cast<Real>(length);
    points.pull_off_force = static_cast<Real>(3 * unit);
    points.overlap_C = static_cast<Real>(-0.75L * std::cbrt(4.0L / 9) * length);
    points.overlap_B = static_cast<Real>(std::cbrt(3.0L) * length);
    points.overlap_S = static_cast<Real>(-3 / std::cbrt(16.0L) * length);
    points.radius_C = static_cast<Real>(std::cbrt(9 * pi * gamma * radius * radius / (4 * modulus)));
    // dF/dD at y^3 = 3: (8 y^5 - 12 y^2) / (4 y^3 - 2) = 12 y^2 / 10.
    points.stiffness_B = static_cast<Real>(1.2L * std::cbrt(9.0L) * unit / length);
    points.peel_unit = static_cast<Real>(peel);
    points.work_CA = static_cast<Real>(11.1200681094345L * peel);
    points.work_SA = static_cast<Real>(22.516318693003L * peel);
    return points;
}

} // namespace arenite
