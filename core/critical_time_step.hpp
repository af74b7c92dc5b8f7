// SPDX-License-Identifier: MIT
// How large a grain step may be. Velocity Verlet is stable below 2 / omega_max; for a dense pack with
// rotation that limit is below Rayleigh's time, which most codes quote.
#pragma once

#include "core/material.hpp"

namespace arenite {

struct TimeStepLimits {
    Real smallest_diameter = 0; // m
    Real smallest_mass = 0;     // kg
    Real pressure = 0;          // Pa that `lattice` is for
    Real rayleigh = 0;          // s, of the smallest grain
    Real lattice = 0;           // s, 2 / omega_max of an FCC lattice of the smallest grains under `pressure`; 0: no limit
    Real contact_period = 0;    // s, 2 pi sqrt(m* / k_n) of a pair in that lattice; 0: no stiffness without pressure

    /// The smaller of the two limits, s: what time_step_fraction refers to.
    Real critical() const { return lattice > 0 && lattice < rayleigh ? lattice : rayleigh; }
};

/// Contact radius [m] of a pair pressed with `force` [N]: JKR's closed form, Hertz for gamma = 0.
Real contact_radius_at(Real force, Real effective_radius, PairConstants const& pair);

/// Limits for grains of this diameter, material and pair law under a pressure. With tangential springs the
/// stiffest mode is one of counter-rotation, dt = 2 sqrt(3 m / (10 Z k_t)) with Z = 12 contacts (exact for FCC);
/// without them it is 2 / sqrt(8 k_n / m).
TimeStepLimits time_step_limits(Real diameter, MaterialSettings const& material, PairConstants const& pair, Real pressure);

} // namespace arenite
