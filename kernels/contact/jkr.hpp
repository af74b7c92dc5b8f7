// SPDX-License-Identifier: MIT
// JKR contact (Johnson, Kendall & Roberts 1971; paper eqs 12, 13) by its universal curve, and the life of
// an adhering contact: where it forms and where it snaps (full and modified JKR, physics.md section 1).
//
// With y = sqrt(s), s = a / (pi gamma R*^2/E*)^(1/3), the overlap is D = overlap / L = y^4 - 2 y and the
// force F / (pi gamma R*) = 4/3 y^6 - 4 y^3. On the stable branch y = y_S + z, z >= 0, where z solves
//     z^2 (z^2 + 4 y_S z + 6 y_S^2) = t^2,   t = sqrt(D - D_S),
// which is well conditioned up to the vertical tangent at S. A rational function of
// v = sqrt(t + 3/2) - sqrt(3/2) gives z to 5e-10 for t <= 124 (overlap <= 27000 |delta_C|), one Newton step
// squares that: the result is exact to rounding, without a branch, a table or a test for convergence.
#pragma once

#include "core/jkr_points.hpp"
#include "kernels/contact/hertz.hpp"

#include <numbers>

namespace arenite {

/// y of the stable branch for D = overlap / L >= D_S; below D_S the value at S.
KOKKOS_FUNCTION inline Real jkr_root(Real scaled_overlap)
{
    constexpr Real y_S = 0.79370052598409974;                       // 2^(-1/3)
    constexpr Real shift = 1.5, root_of_shift = 1.2247448713915890; // sqrt(3/2)
    Real const square = Kokkos::fmax(scaled_overlap - jkr_points::overlap_S, Real(0));
    Real const t = Kokkos::sqrt(square);
    Real const v = t / (Kokkos::sqrt(t + shift) + root_of_shift);
    // Fitted by iterated weighted least squares to z(v)/v on Chebyshev nodes, v in [0, 10].
    Real const numerator =
        (((0.3239110302929624 * v + 1.9826330073992697) * v + 4.219790593539728) * v + 3.776546358655918) * v +
        1.2599210492641482;
    Real const denominator =
        (((0.3239109768047354 * v + 1.8430147453437336) * v + 3.6682784835468767) * v + 3.1183321643698894) * v + 1;
    // The fit is of z/v; a touch above 0 keeps Newton's slope from vanishing at S itself.
    Real const z = Kokkos::fmax(v * (numerator / denominator), Real(1e-30));
    Real const value = z * z * ((z + 4 * y_S) * z + 6 * y_S * y_S) - square;
    Real const slope = z * ((4 * z + 12 * y_S) * z + 12 * y_S * y_S);
    return y_S + Kokkos::fmax(z - value / slope, Real(0));
}

/// Force and contact radius on the stable branch; overlap may be negative down to delta_S.
KOKKOS_FUNCTION inline NormalResponse jkr_response(Real overlap, ContactScale const& scale, PairConstants const& pair)
{
    Real const cube_root = scale.cube_root_of_radius;
    Real const y = jkr_root(overlap / (pair.length_factor * cube_root));
    Real const y3 = y * y * y;
    Real const force_unit = std::numbers::pi_v<Real> * pair.surface_energy * scale.effective_radius;
    return {force_unit * (Real(4) / 3 * y3 - 4) * y3, pair.radius_factor * cube_root * cube_root * y * y, 3 * force_unit,
            true};
}

/// An adhering contact follows the JKR curve until it snaps at the pair's break point. Full JKR forms one
/// at every touch (the force jumps to -8/9 F_C), modified JKR never again: then Hertz.
struct JkrNormal {
    static constexpr bool adheres = true;

    KOKKOS_FUNCTION NormalResponse operator()(Real overlap, ContactScale const& scale, PairConstants const& pair,
                                              std::uint8_t& adhering) const
    {
        if (adhering && overlap < pair.break_overlap * pair.length_factor * scale.cube_root_of_radius) adhering = 0;
        if (!adhering && overlap >= 0 && pair.forms_on_touch) adhering = 1;
        if (adhering) return jkr_response(overlap, scale, pair);
        if (overlap <= 0) return {};
        return hertz_response(overlap, scale.effective_radius, pair.effective_youngs_modulus);
    }
};

} // namespace arenite
