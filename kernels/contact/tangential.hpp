// SPDX-License-Identifier: MIT
// The tangential spring: its history rides with the turning contact, and its force stays inside the
// Coulomb limit (paper eqs 4, 5, 35).
#pragma once

#include "kernels/contact/normal_response.hpp"
#include "core/vec3.hpp"

namespace arenite {

/// How a contact turned in a step: what the spring's transport and the slip of the surfaces share.
struct ContactTurn {
    Vec3 sum;           // previous normal + normal
    Real inverse = 0.5; // 1 / (1 + previous normal . normal)
};

KOKKOS_FUNCTION inline ContactTurn contact_turn(Vec3 const& previous_normal, Vec3 const& normal)
{
    return {previous_normal + normal, 1 / (1 + dot(previous_normal, normal))};
}

/// Unit vector along `vector`, whose length is near 1 / inverse_guess: a series in place of root and division, exact to
/// rounding where the length is within 1e-3 of it, which a contact does not leave in a step.
KOKKOS_FUNCTION inline Vec3 normalized_near(Vec3 const& vector, Real inverse_guess)
{
    Real const q = dot(vector, vector) * inverse_guess * inverse_guess - 1;
    if (!(Kokkos::fabs(q) < Real(1e-3))) return normalized(vector);
    Real const series = 1 - q * (Real(0.5) - q * (Real(0.375) - q * (Real(0.3125) - q * Real(0.2734375))));
    return (inverse_guess * series) * vector;
}

/// Carries a vector of the old contact plane into the new one, as the contact turns: the smallest rotation
/// that takes the previous normal to normal (exact, so the length is kept), then by the angle twist [rad] about
/// normal. Projecting instead would shorten the spring at every step.
KOKKOS_FUNCTION inline Vec3 transport_spring(Vec3 const& spring, ContactTurn const& turn, Vec3 const& normal, Real twist)
{
    Vec3 const tilted = spring - (dot(spring, normal) * turn.inverse) * turn.sum;
    // Rotation by a small angle: cos and sin to fifth order, exact to rounding for twist < 1e-3.
    Real const square = twist * twist;
    Real const sine = twist * (1 - square / 6), cosine = 1 - square * (Real(0.5) - square / 24);
    return cosine * tilted + sine * cross(normal, tilted);
}

KOKKOS_FUNCTION inline Vec3 transport_spring(Vec3 const& spring, Vec3 const& previous_normal, Vec3 const& normal,
                                             Real twist)
{
    return transport_spring(spring, contact_turn(previous_normal, normal), normal, twist);
}

/// Velocity [m/s] of i's surface relative to j's over the step of the turn, approach being that of the centres.
/// The spins (arm-weighted: arm_i omega_i + arm_j omega_j) act on the step's mean normal, and the tangential part
/// is perpendicular to it: for a rigid turn about any axis k by any angle, n - n' = 2 tan(angle/2) k x (n + n')/2
/// (Cayley), so that a pair that turns as one body does not slip. With the new normal alone the spring of such
/// a pair would creep in proportion to dt.
KOKKOS_FUNCTION inline Vec3 surface_velocity(Vec3 const& approach, Vec3 const& arm_spin, ContactTurn const& turn,
                                             Vec3 const& normal)
{
    Vec3 const relative = approach - Real(0.5) * cross(arm_spin, turn.sum);
    Vec3 const slip = relative - (Real(0.5) * dot(relative, turn.sum) * turn.inverse) * turn.sum;
    return slip + dot(approach - slip, normal) * normal;
}

/// A spin as Cayley's relation counts it: 2/dt tan(omega dt/2), to the order that matters below 0.01 rad a step.
KOKKOS_FUNCTION inline Vec3 step_spin(Vec3 const& spin, Real dt) { return (1 + dot(spin, spin) * dt * dt / 12) * spin; }

/// How the spring's stretch follows a changing contact radius (contact variants `secant`, `rescaled`,
/// `incremental`). `rescaled` shrinks it on unloading (as LAMMPS' mindlin_rescale; Walton & Braun 1986),
/// `incremental` adds dF = S_t dxi: both take energy from an impact to which the secant form F = S_t(a) xi gives
/// some. None is free of it: sheared while light and back while pressed, `secant` and `rescaled` make energy, the
/// other way round `incremental` does.
KOKKOS_FUNCTION inline Real stretch_factor(TangentialLaw law, Real previous_radius, Real radius)
{
    if (!(previous_radius > 0)) return 1;
    if (law == TangentialLaw::rescaled && radius < previous_radius) return radius / previous_radius;
    if (law == TangentialLaw::incremental) return previous_radius / radius;
    return 1;
}

/// The largest tangential force [N] that the contact carries.
KOKKOS_FUNCTION inline Real friction_limit(PairConstants const& pair, NormalResponse const& normal, Real normal_force)
{
    if (!(normal.pull_off_force > 0)) return pair.friction * Kokkos::fmax(normal_force, Real(0));
    if (pair.friction_limit == FrictionLimit::paper) return pair.friction * Kokkos::fabs(normal_force);
    // Thornton 1991: the adhesion presses the surfaces together too.
    return pair.friction * Kokkos::fmax(normal_force + 2 * normal.pull_off_force, Real(0));
}

struct NoTangential {
    static constexpr bool has_history = false;

    KOKKOS_FUNCTION Vec3 operator()(Vec3 const&, NormalResponse const&, Real, PairConstants const&, Vec3&, Real&,
                                    Real) const
    {
        return {};
    }
};

/// F_t = -S_t xi - c_t v_t, S_t = 8 G* a, c_t = 2 sqrt(5/6) beta sqrt(S_t m*). The spring is cut to what the
/// limit allows, and the sum with the dashpot is capped at the limit.
struct CoulombSpring {
    static constexpr bool has_history = true;

    KOKKOS_FUNCTION Vec3 operator()(Vec3 const& slip_velocity, NormalResponse const& normal, Real normal_force,
                                    PairConstants const& pair, Vec3& spring, Real& previous_radius, Real dt) const
    {
        Real const stiffness = 8 * pair.effective_shear_modulus * normal.contact_radius;
        Real const limit = friction_limit(pair, normal, normal_force);
        spring = stretch_factor(pair.tangential, previous_radius, normal.contact_radius) * spring + dt * slip_velocity;
        previous_radius = normal.contact_radius;
        // Squares are compared, so that only a contact that slides pays for a root.
        Real const trial = stiffness * stiffness * dot(spring, spring);
        if (trial > limit * limit) spring *= limit / Kokkos::sqrt(trial);
        Vec3 force = -stiffness * spring - (pair.tangential_damping_ratio * normal.dashpot) * slip_velocity;
        Real const square = dot(force, force);
        if (square > limit * limit) force *= limit / Kokkos::sqrt(square);
        return force;
    }
};

} // namespace arenite
