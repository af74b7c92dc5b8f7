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

/// a - b x c, product by product, so that multiply-adds take it whole.
template <class N>
KOKKOS_FORCEINLINE_FUNCTION Vector<N> less_cross(Vector<N> const& a, Vector<N> const& b, Vector<N> const& c)
{
    return {a.x - b.y * c.z + b.z * c.y, a.y - b.z * c.x + b.x * c.z, a.z - b.x * c.y + b.y * c.x};
}

/// The turn of a step in which the centres went along straight lines, as they do between two evaluations. offset [m]: from
/// the second centre to the first, of length `distance`, with its inverse [1/m], 0 for concentric grains; approach [m/s]:
/// the first centre's velocity relative to the second's, normal_velocity its part along the normal.
template <class N>
KOKKOS_FORCEINLINE_FUNCTION ContactTurn<N> straight_turn(Vector<N> const& offset, N const& distance,
                                                         N const& inverse_distance, Vector<N> const& normal,
                                                         Vector<N> const& approach, N const& normal_velocity, Real dt)
{
    Vector<N> const previous = offset - dt * approach;
    N const ahead = distance - dt * normal_velocity; // previous . normal
    // A series in place of root and division, exact to rounding where the length changed by less than 5e-4.
    N const square = dot(previous, previous), q = square * (inverse_distance * inverse_distance) - 1;
    N const series = 1 - q * (Real(0.5) - q * (Real(0.375) - q * (Real(0.3125) - q * Real(0.2734375))));
    N const scale = inverse_distance * series;
    ContactTurn<N> const turn{normal + scale * previous, 1 / (1 + scale * ahead)};
    auto const usual = magnitude(q) < N(1e-3) && ahead > N(0);
    if (all(usual)) return turn;
    Vector<N> const direction = (1 / square_root(square)) * previous;
    // Centres that passed each other within the step have no turn to follow.
    ContactTurn<N> const other = contact_turn(select(dot(direction, normal) > N(0), direction, normal), normal);
    return {select(usual, turn.sum, other.sum), select(usual, turn.inverse, other.inverse)};
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

/// How i's surface moves relative to j's at the contact.
template <class N = Real> struct SurfaceMotion {
    N normal_velocity = 0; // m/s, positive where they part
    Vector<N> slip;        // m/s, in the contact plane
};

template <class N>
KOKKOS_FORCEINLINE_FUNCTION SurfaceMotion<N> surface_motion(Vector<N> const& velocity, Vector<N> const& normal)
{
    N const along = dot(velocity, normal);
    return {along, velocity - along * normal};
}

/// The same over the step of the turn, approach being the velocity of the centres and normal_velocity its part along the
/// normal. The spins (half_arm_spin: half of arm_i omega_i + arm_j omega_j) act on the step's mean normal, and the
/// tangential part is perpendicular to it: for a rigid turn about any axis k by any angle, n - n' = 2 tan(angle/2) k x (n +
/// n')/2 (Cayley), so that a pair that turns as one body does not slip. With the new normal alone the spring of such a pair
/// would creep in proportion to dt.
template <class N>
KOKKOS_FORCEINLINE_FUNCTION SurfaceMotion<N> surface_motion(Vector<N> const& approach, N const& normal_velocity,
                                                            Vector<N> const& half_arm_spin, ContactTurn<N> const& turn,
                                                            Vector<N> const& normal)
{
    // What the spins do is perpendicular to the sum already.
    N const along = Real(0.5) * dot(approach, turn.sum) * turn.inverse;
    Vector<N> const slip = less_cross(approach - along * turn.sum, half_arm_spin, turn.sum);
    return {normal_velocity, slip - dot(slip, normal) * normal};
}

/// What makes of the spins of a pair (sum: omega_i + omega_j) spins as Cayley's relation counts them, 2/dt tan(omega dt/2):
/// for a pair that turns as one body, to the order that matters below 0.01 rad a step.
template <class N> KOKKOS_FORCEINLINE_FUNCTION N cayley_factor(Vector<N> const& spin_sum, Real dt)
{
    return 1 + dot(spin_sum, spin_sum) * (dt * dt * (Real(1) / 48));
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

/// The factor, 1 or less, that brings a force of this square [N2] down to the limit [N].
template <class N> KOKKOS_FORCEINLINE_FUNCTION N cut_to(N const& limit, N const& square)
{
    // One contact saves the root; of several lanes one or another slides at random, and a processor that guesses wrong
    // loses more than the root costs.
    if constexpr (NumberTraits<N>::lanes == 1)
        if (square <= limit * limit) return 1;
    return smaller(limit / square_root(square), N(1));
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
        spring *= cut_to(limit, stiffness * stiffness * dot(spring, spring));
        Vector<N> const force = -stiffness * spring - (pair.tangential_damping_ratio * normal.dashpot) * slip_velocity;
        return cut_to(limit, dot(force, force)) * force;
    }
};

} // namespace arenite
