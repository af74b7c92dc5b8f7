// SPDX-License-Identifier: MIT
// One sphere against a plane, moved on the host by the integrator's kick-drift-kick under the law that the
// kernels run. With the mass m* and the radius R* of a pair it is also the relative motion of two spheres
// along their line. The arm of the friction is the radius, as in the printed reference solutions.
#pragma once

#include "apps/verify/materials.hpp"
#include "kernels/contact/contact_laws.hpp"

namespace arenite {

struct SphereOnPlane {
    PairConstants pair;
    ContactScale<> scale;
    Real radius = 0, mass = 0;
    Vec3 gravity;                  // m/s2
    Vec3 position, velocity, spin; // position.z = 0 is the touch
    ContactState<> state;
    Vec3 force, torque;
    CementedSand law; // runs dry pairs too
};

inline SphereOnPlane make_sphere_on_plane(PairConstants const& pair, MaterialSettings const& material, Real radius)
{
    SphereOnPlane sphere;
    sphere.pair = pair;
    sphere.scale = contact_scale(material, radius, 0);
    sphere.radius = radius;
    sphere.mass = sphere.scale.effective_mass;
    return sphere;
}

/// Two equal spheres as their relative motion; no spin.
inline SphereOnPlane make_collinear_pair(PairConstants const& pair, MaterialSettings const& material, Real radius)
{
    SphereOnPlane sphere;
    sphere.pair = pair;
    sphere.scale = contact_scale(material, radius, radius);
    sphere.radius = radius;
    sphere.mass = sphere.scale.effective_mass;
    return sphere;
}

inline void evaluate_force(SphereOnPlane& sphere, Real dt)
{
    Vec3 const normal{0, 0, 1};
    ContactGeometry<> const contact{normal, -sphere.position.z,
                                    surface_motion(sphere.velocity - sphere.radius * cross(sphere.spin, normal), normal),
                                    sphere.scale};
    Vec3 const push = sphere.law(contact, sphere.pair, sphere.state, dt);
    sphere.force = push + sphere.mass * sphere.gravity;
    sphere.torque = -sphere.radius * cross(normal, push);
}

inline void half_kick(SphereOnPlane& sphere, Real dt)
{
    Real const inertia = Real(0.4) * sphere.mass * sphere.radius * sphere.radius;
    sphere.velocity += (dt / 2 / sphere.mass) * sphere.force;
    sphere.spin += (dt / 2 / inertia) * sphere.torque;
}

inline void step(SphereOnPlane& sphere, Real dt)
{
    half_kick(sphere, dt);
    sphere.position += dt * sphere.velocity;
    evaluate_force(sphere, dt);
    half_kick(sphere, dt);
}

/// Steps until the contact that is now being made has ended, or most steps are over; the number of steps.
inline int run_impact(SphereOnPlane& sphere, Real dt, int most)
{
    bool touched = false;
    for (int n = 1; n <= most; ++n) {
        step(sphere, dt);
        touched = touched || sphere.state.touching;
        if (touched && !sphere.state.touching) return n;
    }
    return most;
}

/// Hertz impact without damping: largest overlap, largest force and duration (Hertz 1882, Timoshenko & Goodier).
struct HertzImpact {
    Real overlap, force, duration;
};

inline HertzImpact hertz_impact(ContactScale<> const& scale, Real effective_youngs_modulus, Real speed)
{
    Real const root = std::sqrt(scale.effective_radius);
    Real const overlap =
        std::pow(15 * scale.effective_mass * speed * speed / (16 * effective_youngs_modulus * root), Real(0.4));
    // 4 sqrt(pi) Gamma(2/5) / (5 Gamma(9/10)) = 2.943275...
    Real const factor = 4 * std::sqrt(Real(3.14159265358979324)) * std::tgamma(Real(0.4)) / (5 * std::tgamma(Real(0.9)));
    return {overlap, Real(4) / 3 * effective_youngs_modulus * root * std::pow(overlap, Real(1.5)), factor * overlap / speed};
}

} // namespace arenite
