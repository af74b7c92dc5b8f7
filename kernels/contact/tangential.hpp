// SPDX-License-Identifier: MIT
// The tangential spring: its history rides with the turning contact, and its force stays inside the
// Coulomb limit (paper eqs 4, 5, 35).
#pragma once

#include "core/vec3.hpp"
#include "kernels/contact/normal_response.hpp"

namespace arenite {

/// How a contact turned in a step: what the spring's transport and the slip of the surfaces share.
template <class N> struct ContactTurn {
    Vector<N> sum; // previous normal + normal
    N inverse;     // 1 / (1 + previous normal . normal)
};

template <class N>
KOKKOS_FORCEINLINE_FUNCTION ContactTurn<N> contact_turn(Vector<N> const& previous_normal, Vector<N> const& normal)
{
    return {previous_normal + normal, 1 / (1 + dot(previous_normal, normal))};
}

/// Unit vector along `vector`, whose length is near 1 / inverse_guess: a series in place of root and division, exact to
/// rounding where the length is within 1e-3 of it, which a contact does not leave in a step.
template <class N> KOKKOS_FORCEINLINE_FUNCTION Vector<N> normalized_near(Vector<N> const& vector, N const& inverse_guess)
{
    N const q = dot(vector, vector) * inverse_guess * inverse_guess - 1;
    N const series = 1 - q * (Real(0.5) - q * (Real(0.375) - q * (Real(0.3125) - q * Real(0.2734375))));
    Vector<N> const near = (inverse_guess * series) * vector;
    auto const is_near = magnitude(q) < N(1e-3);
    if (all(is_near)) return near;
    return select(is_near, near, normalized(vector));
}

/// Carries a vector of the old contact plane into the new one, as the contact turns: the smallest rotation
/// that takes the previous normal to normal (exact, so the length is kept), then by the angle twist [rad] about
/// normal. Projecting instead would shorten the spring at every step.
template <class N>
KOKKOS_FORCEINLINE_FUNCTION Vector<N> transport_spring(Vector<N> const& spring, ContactTurn<N> const& turn,
                                                       Vector<N> const& normal, N const& twist)
{
    Vector<N> const tilted = spring - (dot(spring, normal) * turn.inverse) * turn.sum;
    // Rotation by a small angle: cos and sin to fifth order, exact to rounding for twist < 1e-3.
    N const square = twist * twist;
    N const sine = twist * (1 - square * Real(1.0 / 6)), cosine = 1 - square * (Real(0.5) - square * Real(1.0 / 24));
    return cosine * tilted + sine * cross(normal, tilted);
}

KOKKOS_FORCEINLINE_FUNCTION Vec3 transport_spring(Vec3 const& spring, Vec3 const& previous_normal, Vec3 const& normal,
                                                  Real twist)
{
    return transport_spring(spring, contact_turn(previous_normal, normal), normal, twist);
}

/// Velocity [m/s] of i's surface relative to j's over the step of the turn, approach being that of the centres.
/// The spins (arm-weighted: arm_i omega_i + arm_j omega_j) act on the step's mean normal, and the tangential part
/// is perpendicular to it: for a rigid turn about any axis k by any angle, n - n' = 2 tan(angle/2) k x (n + n')/2
/// (Cayley), so that a pair that turns as one body does not slip. With the new normal alone the spring of such
/// a pair would creep in proportion to dt.
template <class N>
KOKKOS_FORCEINLINE_FUNCTION Vector<N> surface_velocity(Vector<N> const& approach, Vector<N> const& arm_spin,
                                                       ContactTurn<N> const& turn, Vector<N> const& normal)
{
    Vector<N> const relative = approach - Real(0.5) * cross(arm_spin, turn.sum);
    Vector<N> const slip = relative - (Real(0.5) * dot(relative, turn.sum) * turn.inverse) * turn.sum;
    return slip + dot(approach - slip, normal) * normal;
}

/// A spin as Cayley's relation counts it: 2/dt tan(omega dt/2), to the order that matters below 0.01 rad a step.
template <class N> KOKKOS_FORCEINLINE_FUNCTION Vector<N> step_spin(Vector<N> const& spin, Real dt)
{
    return (1 + dot(spin, spin) * (dt * dt / 12)) * spin;
}

/// How the spring's stretch follows a changing contact radius (contact variants `secant`, `rescaled`,
/// `incremental`, `dissipative`). The spring holds U = 1/2 S_t(a) xi^2, and nothing but slip puts energy into it, so U
/// must not grow with a. `secant` keeps xi (F = S_t xi, the paper's form): pressing a sheared contact makes energy.
/// `rescaled` shrinks xi on unloading (as LAMMPS' mindlin_rescale; Walton & Braun 1986) and makes energy on loading
/// like `secant`. `incremental` keeps F (dF = S_t dxi): unloading makes energy. `dissipative` keeps F while a grows,
/// as a contact of growing area does (Mindlin & Deresiewicz 1953), and xi while it shrinks: U never grows.
template <class N> KOKKOS_FORCEINLINE_FUNCTION N stretch_factor(TangentialLaw law, N const& previous_radius, N const& radius)
{
    if (law == TangentialLaw::secant) return 1;
    auto const known = previous_radius > N(0) && radius > N(0);
    if (law == TangentialLaw::rescaled) return select(known, smaller(radius / previous_radius, N(1)), N(1));
    if (law == TangentialLaw::dissipative) return select(known, smaller(previous_radius / radius, N(1)), N(1));
    return select(known, previous_radius / radius, N(1));
}

/// The largest tangential force [N] that the contact carries.
template <class N>
KOKKOS_FORCEINLINE_FUNCTION N friction_limit(PairConstants const& pair, NormalResponse<N> const& normal,
                                             N const& normal_force)
{
    // Thornton 1991: the adhesion presses the surfaces together too. Without adhesion both forms are mu F_n.
    if (pair.friction_limit == FrictionLimit::thornton || !any(normal.pull_off_force > N(0)))
        return pair.friction * larger(normal_force + 2 * normal.pull_off_force, N(0));
    N const dry = pair.friction * larger(normal_force, N(0));
    return select(normal.pull_off_force > N(0), pair.friction * magnitude(normal_force), dry);
}

struct NoTangential {
    static constexpr bool has_history = false;

    template <class N>
    KOKKOS_FORCEINLINE_FUNCTION Vector<N> operator()(Vector<N> const&, NormalResponse<N> const&, N const&,
                                                     PairConstants const&, Vector<N>&, N&, Real) const
    {
        return {};
    }
};

/// F_t = -S_t xi - c_t v_t, S_t = 8 G* a, c_t = 2 sqrt(5/6) beta sqrt(S_t m*). The spring is cut to what the
/// limit allows, and the sum with the dashpot is capped at the limit.
struct CoulombSpring {
    static constexpr bool has_history = true;

    template <class N>
    KOKKOS_FORCEINLINE_FUNCTION Vector<N> operator()(Vector<N> const& slip_velocity, NormalResponse<N> const& normal,
                                                     N const& normal_force, PairConstants const& pair, Vector<N>& spring,
                                                     N& previous_radius, Real dt) const
    {
        N const stiffness = 8 * pair.effective_shear_modulus * normal.contact_radius;
        N const limit = friction_limit(pair, normal, normal_force);
        spring = stretch_factor(pair.tangential, previous_radius, normal.contact_radius) * spring + dt * slip_velocity;
        previous_radius = normal.contact_radius;
        // Squares are compared, so that only a contact that slides pays for a root.
        N const trial = stiffness * stiffness * dot(spring, spring);
        auto const slides = trial > limit * limit;
        if (any(slides)) spring *= select(slides, limit / square_root(trial), N(1));
        Vector<N> force = -stiffness * spring - (pair.tangential_damping_ratio * normal.dashpot) * slip_velocity;
        N const square = dot(force, force);
        auto const exceeds = square > limit * limit;
        if (any(exceeds)) force *= select(exceeds, limit / square_root(square), N(1));
        return force;
    }
};

} // namespace arenite
