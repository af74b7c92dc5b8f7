// SPDX-License-Identifier: MIT
// What grains and fluid give each other in a fluid step (physics.md sections 2 and 3, model A):
//
//   deposit_porosity(flow, exchange, particles);     n and dn/dt of the grains where they are now
//   deposit_drag(flow, exchange, particles, dt);     B and b of drag = B u - b, beta at the old field
//   advance_flow(flow, boundary, solver, dt);        drag implicit in u
//   evaluate_fluid_force(flow, solver, exchange, particles);   held by the grains until the next fluid step
//
// Rows of the particles must not be moved from the first of these calls to the last. The force on grain j is
// beta_j' (u - v_j') + V_j (-grad p + div tau) with u and the gradients interpolated by the weights of the
// deposit: so what the grains get, the fluid and its boundary lose, to rounding. beta' and v' make the held force that
// of the step's end (deposit_drag): stable for any fluid step, accurate for steps below m/beta of the lightest grain
// (sand of 0.15 mm in a dense bed: 1.5e-4 s); check_exchange tells.
#pragma once

#include "fluid/coupled_set.hpp"
#include "fluid/deposit.hpp"
#include "fluid/drag.hpp"
#include "fluid/flow_solver.hpp"

#include <string>
#include <vector>

namespace arenite {

/// What a fluid step did to the grains' side; nothing is limited or left out without a number here.
struct ExchangeReport {
    int coupled = 0;           // grains in the fluid's box
    int limited_cells = 0;     // cells whose porosity was below the minimum and was set to it
    Real limited_volume = 0;   // m3 of grains that those cells hold too much: unseen by the fluid
    Real lowest_porosity = 1;  // before the limit
    int entered = 0, left = 0; // grains that began or ceased to be coupled since the last step
};

struct Exchange {
    AnyDragLaw drag_law;
    DepositStencil stencil;
    Real coarse_grain_factor = 1;
    Real minimum_porosity = 0;

    GrainWeights weights; // of the grains where deposit_porosity saw them
    TableView volume;     // [entry][1] m3
    TableView drag;       // [entry](beta' v'x, beta' v'y, beta' v'z, beta'), N and N s/m; see deposit_drag
    Real time_step = 0;   // s, of the drag
    TableView cell_sum;   // [cell][4] what deposit gives
    TableView cell_value; // [cell][6, padded] what interpolate_at reads
    CoupledSet coupled;   // the grains of the last deposit; a checkpoint of a coupled run holds it
    CoupledSet spare;     // arrays for the next one
    ExchangeReport report;
};

/// For a flow made with grains; allocates the grains' fluid_force.
Exchange make_exchange(Flow const& flow, Particles& particles, FluidSettings const& settings, Real coarse_grain_factor);

/// porosity_previous <- porosity, porosity <- 1 - grain volume / cell volume, not below the minimum. The first
/// call sets both. A grain that enters or leaves the box (or the run) does so in both porosities: it is
/// replaced by fluid at once, and dn/dt holds only motion.
void deposit_porosity(Flow& flow, Exchange& exchange, Particles const& particles);

/// beta of every grain from the field as it is, and flow.drag, flow.drag_velocity from it, for a fluid step of dt [s].
/// Implicit in the grain's velocity too: beta' = beta / (1 + beta dt / m) and v' = v + dt F / m, F being what else acts on
/// the grain, so that a step of any length is stable and a grain at rest on others feels beta u.
void deposit_drag(Flow& flow, Exchange& exchange, Particles const& particles, Real dt);

/// particles.fluid_force from the field as it is now; 0 for grains outside the box. Its fourth component is beta.
void evaluate_fluid_force(Flow const& flow, FlowSolver const& solver, Exchange const& exchange, Particles& particles);

/// max of dt beta / m over the free grains, from the last deposit_drag.
Real drag_stiffness(Exchange const& exchange, Particles const& particles);

/// Sentences on what makes the coupling inaccurate, with values; empty if all is well. After
/// deposit_drag.
std::vector<std::string> check_exchange(Exchange const& exchange, Particles const& particles);

} // namespace arenite
