// SPDX-License-Identifier: MIT
// The fluid's state on the staggered grid, model A of the locally averaged Navier-Stokes equations
// (physics.md section 3; Zhou et al. 2010):
//
//   dn/dt + div(n u) = 0
//   d(rho n u)/dt + div(rho n u u) = -n grad p + n div(tau) + n rho g - (B u - b)
//
// with n the porosity, u the interstitial velocity and B u - b the drag per volume: B = sum_j beta_j / V,
// b = sum_j beta_j v_j / V over the grains, beta_j the linearised drag coefficient of grain j. The drag is
// implicit in u, so a step of any length is stable.
#pragma once

#include "core/grid.hpp"
#include "core/scene.hpp"

namespace arenite {

struct Flow {
    Grid grid;
    Real density = 0;   // kg/m3
    Real viscosity = 0; // Pa s
    Vec3 body_force;    // Pa/m, rho g included where the scene has gravity

    FieldView velocity[3];       // [face] u, v, w, m/s, interstitial; u(i) is the lower x-face of cell i
    FieldView pressure;          // [cell] p, Pa, hydrostatic part included
    FieldView porosity;          // [cell] n at the new time level, in (0, 1]
    FieldView porosity_previous; // [cell] n at the old time level

    // The grains' side, empty in a flow without grains. What exchange.hpp deposits.
    FieldView drag;             // [cell] B, N s/m4
    FieldView drag_velocity[3]; // [cell] b, N/m3

    KOKKOS_FUNCTION bool has_drag() const { return drag.is_allocated(); }
};

/// What one fluid step reports; the driver writes it to history.csv and stops on trouble.
struct FlowReport {
    int pressure_iterations = 0;
    Real pressure_residual = 0;   // relative
    Real continuity_error = 0;    // max |dn/dt + div(n u)| * dt, dimensionless
    Real courant = 0;             // max |u| dt / dx
    Real inflow = 0, outflow = 0; // m3/s of fluid through the boundary, both >= 0
    bool velocity_converged = true, pressure_converged = true;

    bool converged() const { return velocity_converged && pressure_converged; }
};

} // namespace arenite
