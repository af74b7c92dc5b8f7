// SPDX-License-Identifier: MIT
// Materials of the checks: the paper's sand, and those of Chung & Ooi (2011).
#pragma once

#include "kernels/contact/normal_response.hpp"

#include <cmath>

namespace arenite {

inline MaterialSettings make_material(Real density, Real youngs_modulus, Real poissons_ratio)
{
    MaterialSettings material;
    material.density = density;
    material.youngs_modulus = youngs_modulus;
    material.poissons_ratio = poissons_ratio;
    return material;
}

/// The paper's sand at k = 1, without damping and friction unless set.
inline MaterialSettings sand()
{
    MaterialSettings material = make_material(2605, 2e10, 0.3);
    material.surface_energy = 30;
    return material;
}

/// The plane of Chung & Ooi's tests, a thousand times stiffer than what hits it.
inline MaterialSettings stiffer(MaterialSettings material, Real factor)
{
    material.youngs_modulus *= factor;
    return material;
}

inline MaterialSettings with(MaterialSettings material, Real restitution, Real friction)
{
    material.restitution = restitution;
    material.friction = friction;
    return material;
}

inline ContactSettings contact_settings(NormalLaw normal, DampingLaw damping = DampingLaw::none,
                                        TangentialLaw tangential = TangentialLaw::none)
{
    ContactSettings settings;
    settings.normal = normal;
    settings.break_point = normal == NormalLaw::jkr ? BreakPoint::S : BreakPoint::C;
    settings.damping = damping;
    settings.tangential = tangential;
    return settings;
}

inline Real sphere_mass(MaterialSettings const& material, Real radius)
{
    return Real(4) / 3 * Real(3.14159265358979324) * material.density * radius * radius * radius;
}

/// Two spheres of radii a and b; b = 0 is a plane of infinite mass.
inline ContactScale<> contact_scale(MaterialSettings const& material, Real a, Real b)
{
    Real const mass_a = sphere_mass(material, a);
    if (!(b > 0)) return {a, mass_a, 1 / std::cbrt(a)};
    Real const mass_b = sphere_mass(material, b), radius = a * b / (a + b);
    return {radius, mass_a * mass_b / (mass_a + mass_b), 1 / std::cbrt(radius)};
}

} // namespace arenite
