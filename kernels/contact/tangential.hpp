// SPDX-License-Identifier: MIT
// The tangential spring: its history rides with the turning contact, and its force stays inside the
// Coulomb limit (paper eqs 4, 5, 35).
#pragma once

#include "core/vec3.hpp"
#include "kernels/contact/normal_response.hpp"

namespace arenite {

/// a - b x c, product by product, so that multiply-adds take it whole.
template <class N>
KOKKOS_FORCEINLINE_FUNCTION Vector<N> less_cross(Vector<N> const& a, Vector<N> const& b, Vector<N> const& c)
{
    return {a.x - b.y * c.z + b.z * c.y, a.y - b.z * c.x + b.x * c.z, a.z - b.x * c.y + b.y * c.x};
}

/// How the line between two bodies turned in a step: what the spring's transport and the slip of the surfaces share. The
/// line may have any length, so that between grains none of this waits for the root and the quotient that a unit normal
/// takes.
template <class N> struct LineTurn {
    Vector<N> line;   // from the second body to the first
    N inverse_square; // 1 / |line|^2
    Vector<N> mean;   // along n' + n, the sum of the normals before and after, so long that mean . line = |line|^2
};

/// Between two unit normals.
template <class N>
KOKKOS_FORCEINLINE_FUNCTION LineTurn<N> contact_turn(Vector<N> const& previous_normal, Vector<N> const& normal)
{
    return {normal, N(1), (1 / (1 + dot(previous_normal, normal))) * (previous_normal + normal)};
}

/// The turn of a step in which the centres went along straight lines, as they do between two evaluations.
template <class N> struct StraightTurn {
    LineTurn<N> turn;
    Vector<N> across; // m/s, across the line: how the first centre moves relative to the second without what is along `mean`
    N twice_cosine;   // 1 + n' . n = 2 cos^2(angle / 2)
    N parting;        // m2/s: line . (velocity of the first centre relative to the second)
};

/// line [m]: from the second centre to the first, with the inverse of its square; approach [m/s]: the first centre's
/// velocity relative to the second's. With u the part of it across the line and v_n that along it, the angle of the turn has
/// tan(angle) = |u| / (d/dt - v_n); all else follows from tan(angle / 2).
template <class N>
KOKKOS_FORCEINLINE_FUNCTION StraightTurn<N> straight_turn(Vector<N> const& line, N const& inverse_square,
                                                          Vector<N> const& approach, Real dt)
{
    N const parting = dot(line, approach), rate = parting * inverse_square, grown = dt * rate; // of the distance
    Vector<N> const across = approach - rate * line;
    N const square = dot(across, across); // |u|^2
    // Series in place of roots and quotients, exact to rounding where a step neither turns nor stretches the line by much.
    N const time = dt * (1 + grown * (1 + grown * (1 + grown))); // tan(angle) d / |u|
    N time_over_square = time * inverse_square;
    N const tangent = time * time_over_square * square; // tan^2(angle)
    N cosine = 1 - tangent * (Real(0.5) - Real(0.375) * tangent);
    N half = time * (Real(0.5) - tangent * (Real(0.125) - Real(0.0625) * tangent)); // tan(angle / 2) d / |u|
    auto const usual = magnitude(grown) < N(1e-4) && tangent < N(4e-6);
    if (!all(usual)) [[unlikely]] {
        // Centres that passed each other within the step, or are at one point now, have no turn to follow.
        N exact = select(grown < N(1), dt / (1 - grown), N(0));
        exact = select(exact * exact * (square * inverse_square) < N(1e12), exact, N(0));
        N const secant = square_root(1 + exact * exact * (square * inverse_square));
        time_over_square = select(usual, time_over_square, exact * inverse_square);
        cosine = select(usual, cosine, 1 / secant);
        half = select(usual, half, exact / (1 + secant));
    }
    // What remains of `across`, seen across the line, if what is along `mean` goes as well.
    N const kept = 1 + Real(0.5) * (time_over_square * cosine * (parting - half * square));
    return {{line, inverse_square, line - half * across}, kept * across, 1 + cosine, parting};
}

/// Carries a vector of the old contact plane into the new one, as the contact turns: the smallest rotation
/// that takes the previous normal to normal (exact, so the length is kept), then about the normal by an angle of twist /
/// |line|. Projecting instead would shorten the spring at every step.
template <class N>
KOKKOS_FORCEINLINE_FUNCTION Vector<N> transport_spring(Vector<N> const& spring, LineTurn<N> const& turn, N const& twist)
{
    Vector<N> const tilted = spring - (dot(spring, turn.line) * turn.inverse_square) * turn.mean;
    // Rotation by a small angle: cos and sin to fifth order, exact to rounding for angles below 1e-3.
    N const square = twist * twist * turn.inverse_square;
    N const sine = twist * turn.inverse_square * (1 - square * Real(1.0 / 6)),
            cosine = 1 - square * (Real(0.5) - square * Real(1.0 / 24));
    return less_cross(cosine * tilted, sine * tilted, turn.line);
}

KOKKOS_FORCEINLINE_FUNCTION Vec3 transport_spring(Vec3 const& spring, Vec3 const& previous_normal, Vec3 const& normal,
                                                  Real twist)
{
    return transport_spring(spring, contact_turn(previous_normal, normal), twist);
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

/// Slip [m/s] over the step of the turn. rolling [1/s]: a_i omega_i + a_j omega_j, a being the arms over the distance;
/// counted: cos^2(angle / 2) cayley_factor. The spins act on the step's mean normal, and the centres' part of the slip is
/// perpendicular to it: for a rigid turn about any axis k by any angle, n - n' = 2 tan(angle/2) k x (n + n')/2 (Cayley), so
/// that a pair that turns as one body does not slip. With the new normal alone the spring of such a pair would creep in
/// proportion to dt.
template <class N>
KOKKOS_FORCEINLINE_FUNCTION Vector<N> slip_over(StraightTurn<N> const& step, Vector<N> const& rolling, N const& counted)
{
    // Across the line, of: the approach without what is along `mean`, less counted rolling x mean.
    LineTurn<N> const& turn = step.turn;
    Vector<N> const level = rolling - (dot(rolling, turn.line) * turn.inverse_square) * turn.mean;
    return less_cross(step.across, counted * level, turn.line);
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
    return smaller(limit * inverse_root(square), N(1));
}

struct NoTangential {
    static constexpr bool has_history = false;

    template <bool, class N>
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

    /// radius_is_late: the contact radius comes later than the slip, at the end of a long chain of operations.
    template <bool radius_is_late, class N>
    KOKKOS_FORCEINLINE_FUNCTION Vector<N> operator()(Vector<N> const& slip_velocity, NormalResponse<N> const& normal,
                                                     N const& normal_force, PairConstants const& pair, Vector<N>& spring,
                                                     N& previous_radius, Real dt) const
    {
        N const stiffness = 8 * pair.effective_shear_modulus * normal.contact_radius;
        N const limit = friction_limit(pair, normal, normal_force);
        spring = stretch_factor(pair.tangential, previous_radius, normal.contact_radius) * spring + dt * slip_velocity;
        previous_radius = normal.contact_radius;
        N const square = dot(spring, spring);
        if constexpr (radius_is_late && NumberTraits<N>::lanes > 1) // then the root has not waited for it
            spring *= smaller(limit * reciprocal(stiffness * square_root(square)), N(1));
        else spring *= cut_to(limit, stiffness * stiffness * square);
        N const dashpot = pair.tangential_damping_ratio * (pair.damping_factor * normal.impedance);
        Vector<N> const force = -stiffness * spring - dashpot * slip_velocity;
        return cut_to(limit, dot(force, force)) * force;
    }
};

} // namespace arenite
