// SPDX-License-Identifier: MIT
#include "core/critical_time_step.hpp"

#include <cmath>
#include <numbers>

namespace arenite {

Real contact_radius_at(Real force, Real effective_radius, PairConstants const& pair)
{
    Real const adhesion = 6 * std::numbers::pi_v<Real> * pair.surface_energy * effective_radius;
    Real const load = force + adhesion + std::sqrt(2 * adhesion * force + adhesion * adhesion);
    return std::cbrt(Real(3) / 4 * effective_radius / pair.effective_youngs_modulus * load);
}

TimeStepLimits time_step_limits(Real diameter, MaterialSettings const& material, PairConstants const& pair, Real pressure)
{
    constexpr Real pi = std::numbers::pi_v<Real>;
    TimeStepLimits limits;
    limits.smallest_diameter = diameter;
    limits.pressure = pressure;
    limits.rayleigh = rayleigh_time(material, diameter / 2);
    Real const mass = material.density * pi / 6 * diameter * diameter * diameter;
    limits.smallest_mass = mass;
    Real const force = pressure * diameter * diameter / (2 * std::numbers::sqrt2_v<Real>); // FCC, per contact
    Real const radius = contact_radius_at(force, diameter / 4, pair);
    if (!(radius > 0)) return limits;
    Real const normal_stiffness = 2 * pair.effective_youngs_modulus * radius;
    Real const tangential_stiffness = 8 * pair.effective_shear_modulus * radius;
    limits.contact_period = 2 * pi * std::sqrt(mass / 2 / normal_stiffness);
    limits.lattice = pair.friction > 0 ? 2 * std::sqrt(3 * mass / (10 * 12 * tangential_stiffness))
                                       : 2 / std::sqrt(8 * normal_stiffness / mass);
    return limits;
}

} // namespace arenite
