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
template <class N> KOKKOS_FORCEINLINE_FUNCTION N jkr_root(N const& scaled_overlap)
{
    constexpr Real y_S = 0.79370052598409974;                       // 2^(-1/3)
    constexpr Real shift = 1.5, root_of_shift = 1.2247448713915890; // sqrt(3/2)
    N const square = larger(scaled_overlap - jkr_points::overlap_S, N(0));
    N const t = square_root(square);
    // t is 0 or at least 1.5e-8 (a rounding of the overlap): the difference keeps seven digits, Newton makes it fourteen.
    N const v = square_root(t + shift) - root_of_shift;
    // Fitted by iterated weighted least squares to z(v)/v on Chebyshev nodes, v in [0, 10].
    // Both halves of a polynomial at the same time: all that a lane does not do is wait for these.
    N const vv = v * v;
    N const numerator =
        ((0.3239110302929624 * v + 1.9826330073992697) * vv + (4.219790593539728 * v + 3.776546358655918)) * v +
        1.2599210492641482;
    N const denominator =
        ((0.3239109768047354 * v + 1.8430147453437336) * vv + (3.6682784835468767 * v + 3.1183321643698894)) * v + 1;
    // The fit is of z/v; a touch above 0 keeps Newton's slope from vanishing at S itself. Newton's step from z = p / q with
    // both sides multiplied by q^4: one quotient in place of two, one after the other.
    N const p = v * numerator + N(1e-30), q = denominator, pp = p * p, pq = p * q, qq = q * q;
    N const value = pp * (pp + 4 * y_S * pq + 6 * y_S * y_S * qq) - square * (qq * qq);
    N const slope = p * (4 * pp + 12 * y_S * pq + 12 * y_S * y_S * qq);
    return y_S + larger((p * slope - value) * reciprocal(q * slope), N(0));
}

/// 1 / L, 1/m.
template <class N> KOKKOS_FORCEINLINE_FUNCTION N jkr_inverse_length(ContactScale<N> const& scale, PairConstants const& pair)
{
    return pair.inverse_length_factor * scale.inverse_cube_root;
}

/// Force and contact radius on the stable branch; overlap may be negative down to delta_S.
template <class N>
KOKKOS_FORCEINLINE_FUNCTION NormalResponse<N> jkr_response(N const& overlap, ContactScale<N> const& scale,
                                                           PairConstants const& pair)
{
    N const y = jkr_root(overlap * jkr_inverse_length(scale, pair));
    N const y3 = y * y * y;
    N const force_unit = std::numbers::pi_v<Real> * pair.surface_energy * scale.effective_radius;
    N const radius_unit = pair.radius_factor * scale.effective_radius * scale.inverse_cube_root; // a = radius_unit y^2
    // The impedance's root does not wait for y.
    return {force_unit * y3 * (Real(4) / 3 * y3 - 4), radius_unit * y * y, 3 * force_unit, MaskOf<N>(true),
            y * square_root(2 * pair.effective_youngs_modulus * scale.effective_mass * radius_unit)};
}

/// An adhering contact follows the JKR curve until it snaps at the pair's break point. Full JKR forms one
/// at every touch (the force jumps to -8/9 F_C), modified JKR never again: then Hertz.
struct JkrNormal {
    static constexpr bool adheres = true, radius_is_late = true;

    template <class N>
    KOKKOS_FORCEINLINE_FUNCTION NormalResponse<N> operator()(N const& overlap, ContactScale<N> const& scale,
                                                             PairConstants const& pair, MaskOf<N>& adhering) const
    {
        adhering = adhering && overlap * jkr_inverse_length(scale, pair) >= pair.break_overlap;
        if (pair.forms_on_touch) adhering = adhering || overlap >= N(0);
        if (!any(adhering)) return HertzNormal{}(overlap, scale, pair, adhering);
        NormalResponse<N> response;
        if (any(overlap > N(0) && !adhering)) response = HertzNormal{}(overlap, scale, pair, adhering);
        NormalResponse<N> const bond = jkr_response(overlap, scale, pair);
        response.force = select(adhering, bond.force, response.force);
        response.contact_radius = select(adhering, bond.contact_radius, response.contact_radius);
        response.pull_off_force = select(adhering, bond.pull_off_force, response.pull_off_force);
        response.impedance = select(adhering, bond.impedance, response.impedance);
        response.touches = response.touches || adhering;
        return response;
    }

    /// Of a contact of known radius: 4/3 E* a^3 / R*, where it adheres less 4 sqrt(pi gamma E* a^3).
    template <class N>
    KOKKOS_FORCEINLINE_FUNCTION static N force_at_radius(N const& contact_radius, N const& effective_radius,
                                                         PairConstants const& pair, MaskOf<N> adhering)
    {
        N const hertz = HertzNormal::force_at_radius(contact_radius, effective_radius, pair, adhering);
        N const size = std::numbers::pi_v<Real> * pair.surface_energy * pair.effective_youngs_modulus;
        return hertz - select(adhering, 4 * square_root(size * contact_radius) * contact_radius, N(0));
    }
};

} // namespace arenite
