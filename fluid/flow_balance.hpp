// SPDX-License-Identifier: MIT
// What the fluid hands to the grains, and the totals that a balance sheet needs.
//
// A step gives each face the force per volume F = -grad p + div tau (FlowSolver::face_force). The fluid takes
// n F, the grains the rest. A grain of volume V_j that is spread over cells with weights w_jc takes
// V_j sum_c w_jc F_c with F_c = stress_force_at_cell, the mean of the cell's two faces; summed over the grains
// this is sum_f (1 - n_f) F_f V_f with n_f the mean of the cells: nothing is lost but rounding. Likewise the
// drag: sum_j beta_j (u_c - v_j) w_jc with u_c = velocity_at_cell equals sum_f (B_f u_f - b_f) V_f.
// V_f is the cell volume, half of it at a boundary face.
#pragma once

#include "fluid/flow_solver.hpp"
#include "fluid/operators.hpp"

namespace arenite {

/// -grad p + div tau at a cell, Pa/m.
KOKKOS_INLINE_FUNCTION Vec3 stress_force_at_cell(Grid const& grid, FaceField const& face_force, Node const& cell)
{
    Vec3 force;
    for (int axis = 0; axis < 3; ++axis) {
        FieldView const& f = face_force.component[axis];
        force[axis] = Real(0.5) * (at(f, cell) + at(f, neighbour(grid, cell, axis, 1)));
    }
    return force;
}

/// The same for every cell: [cell], Pa/m.
void fill_stress_force(Flow const& flow, FlowSolver const& solver, FaceField const& cell_force);

struct FluidTotals {
    Vec3 momentum;           // kg m/s, sum of rho n u over the control volumes of the faces
    Real kinetic_energy = 0; // J
    Real volume = 0;         // of fluid, m3
};

FluidTotals fluid_totals(Flow const& flow, SumWorkspace& sums);

/// Force of walls and openings on the mixture in the last step, N: sum of F over the box.
Vec3 boundary_force(Flow const& flow, FlowSolver& solver);

} // namespace arenite
