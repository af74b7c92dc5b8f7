// SPDX-License-Identifier: MIT
// Grains and fluid stepped together as the stage loop does it: a fluid step from the grains where they are, its
// force held by the grains while they make theirs.
#pragma once

#include "apps/verify/fluid_case.hpp"
#include "apps/verify/grain_system.hpp"
#include "fluid/exchange.hpp"

namespace arenite {

inline Real sphere_volume_of(Real diameter) { return sphere_volume(diameter / 2); }

struct CoupledSettings {
    FluidSettings fluid; // its box is set
    SystemSettings grains;
    Real coarse_grain_factor = 1;
    Vec3 gravity{0, 0, -9.81}; // of the grains; the fluid feels it where fluid.gravity is set
};

struct CoupledCase {
    GrainSystem grains;
    FluidCase fluid;
    Exchange exchange;
    bool converged = true; // every fluid step so far

    /// One fluid step; the grains stay.
    FlowReport exchange_step(Real dt);
    /// One fluid step and as many grain steps as it is long.
    void step(Real dt);
};

CoupledCase make_coupled_case(CoupledSettings const& settings);

/// (u, v, w, n) at grain 0 as the drag law sees it, from the last deposit_drag.
std::array<Real, 4> fluid_at_grain(Exchange const& exchange);

/// Slip [m/s] at which the law's drag and the pressure gradient hold a sphere up in still water, by bisection: the
/// drag has the share n of the weight in the fluid.
Real terminal_slip(FluidSettings const& fluid, Real diameter, Real grain_density, Real porosity);

/// Sum of the fluid's forces on the grains that are free (or on all), N.
Vec3 total_fluid_force(Particles const& particles);

/// The paper's sand by mass (product of its sieve curve), diameters of the original grains.
DistributionSettings paper_sand();

} // namespace arenite
