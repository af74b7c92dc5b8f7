// SPDX-License-Identifier: MIT
// The tangential spring: its history rides with the turning contact, and its force stays inside the
// Coulomb limit (paper eqs 4, 5, 35).
#pragma once

#include "kernels/contact/normal_response.hpp"
#include "core/vec3.hpp"

namespace arenite {

/// Carries a vector of the old contact plane into the new one, as the contact turns: the smallest rotation
/// that takes previous_normal to normal (exact, so the length is kept), then by the angle twist [rad] about
/// normal. Projecting instead would shorten the spring at every step.
KOKKOS_FUNCTION inline Vec3 transport_spring(Vec3 const& spring, Vec3 const& previous_normal, Vec3 const& normal,
                                             Real twist)
{
    Vec3 const tilted =
        spring - (dot(spring, normal) / (1 + dot(previous_normal, normal))) * (previous_normal + normal);
    // Rotation by a small angle: cos and sin to fifth order, exact to rounding for twist < 1e-3.
    Real const square = twist * twist;
    Real const sine = twist * (1 - square / 6), cosine = 1 - square * (Real(0.5) - square / 24);
    return cosine * tilted + sine * cross(normal, tilted);
}

/// Velocity [m/s] of i's surface relative to j's over the step that took previous_normal to normal, approach
/// being that of the centres. The spins (arm-weighted: arm_i omega_i + arm_j omega_j) act on the step's mean
/// normal, and the tangential part is perpendicular to it: for a rigid turn about any axis k by any angle,
/// n - n' = 2 tan(angle/2) k x (n + n')/2 (Cayley), so that a pair that turns as one body does not slip.
/// With the new normal alone the spring of such a pair would creep in proportion to dt.
KOKKOS_FUNCTION inline Vec3 surface_velocity(Vec3 const& approach, Vec3 const& arm_spin, Vec3 const& previous_normal,
                                             Vec3 const& normal)
{
    Vec3 const mean = Real(0.5) * (previous_normal + normal);
    Vec3 const relative = approach - cross(arm_spin, mean);
    Vec3 const slip = relative - (dot(relative, mean) / dot(mean, mean)) * mean;
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

    KOKKOS_FUNCTION Vec3 operator()(Vec3 const&, NormalResponse const&, Real, ContactScale const&, PairConstants const&,
                                    Vec3&, Real&, Real) const
    {
        return {};
    }
};

/// F_t = -S_t xi - c_t v_t, S_t = 8 G* a, c_t = 2 sqrt(5/6) beta sqrt(S_t m*). The spring is cut to what the
/// limit allows, and the sum with the dashpot is capped at the limit.
struct CoulombSpring {
    static constexpr bool has_history = true;

    KOKKOS_FUNCTION Vec3 operator()(Vec3 const& slip_velocity, NormalResponse const& normal, Real normal_force,
                                    ContactScale const& scale, PairConstants const& pair, Vec3& spring,
                                    Real& previous_radius, Real dt) const
    {
        Real const stiffness = 8 * pair.effective_shear_modulus * normal.contact_radius;
        Real const limit = friction_limit(pair, normal, normal_force);
        spring = stretch_factor(pair.tangential, previous_radius, normal.contact_radius) * spring + dt * slip_velocity;
        previous_radius = normal.contact_radius;
        Real const trial = stiffness * norm(spring);
        if (trial > limit) spring *= limit / trial;
        Real const dashpot = pair.damping_factor * Kokkos::sqrt(stiffness * scale.effective_mass);
        Vec3 force = -stiffness * spring - dashpot * slip_velocity;
        Real const size = norm(force);
        if (size > limit) force *= limit / size;
        return force;
    }
};

} // namespace arenite
