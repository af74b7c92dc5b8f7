// SPDX-License-Identifier: MIT
#include "fluid/flow_balance.hpp"

namespace arenite {
namespace {

/// Volume of a face's control volume, m3; 0 for a slot that is no face of the component.
KOKKOS_INLINE_FUNCTION Real control_volume(Grid const& grid, int component, Node const& face)
{
    if (!is_face(grid, component, face)) return 0;
    return grid.cell_volume() * (boundary_side(grid, component, face) == 0 ? Real(1) : Real(0.5));
}

} // namespace

void fill_stress_force(Flow const& flow, FlowSolver const& solver, FaceField const& cell_force)
{
    Grid const grid = flow.grid;
    FaceField const face_force = solver.face_force;
    for_each_cell(
        "fill_stress_force", grid, KOKKOS_LAMBDA(Node const& cell) {
            Vec3 const force = stress_force_at_cell(grid, face_force, cell);
            for (int axis = 0; axis < 3; ++axis) at(cell_force.component[axis], cell) = force[axis];
        });
}

FluidTotals fluid_totals(Flow const& flow_now, SumWorkspace& sums)
{
    Flow const flow = flow_now;
    Grid const grid = flow.grid;
    FluidTotals totals;
    for (int axis = 0; axis < 3; ++axis) {
        Terms<3> const sum = reproducible_sums<3>(
            sums, "fluid_totals", face_slots(grid), KOKKOS_LAMBDA(int f) {
                Node const face = face_of_slot(grid, f);
                Real const volume = control_volume(grid, axis, face);
                if (!(volume > 0)) return Terms<3>{0, 0, 0};
                Real const fluid = volume * mean_at_face(flow.porosity, axis, face), u = at(flow.velocity[axis], face);
                return Terms<3>{fluid * u, fluid * u * u, axis == 0 ? fluid : 0};
            });
        totals.momentum[axis] = flow.density * sum[0];
        totals.kinetic_energy += Real(0.5) * flow.density * sum[1];
        totals.volume += sum[2];
    }
    return totals;
}

Vec3 boundary_force(Flow const& flow, FlowSolver& solver)
{
    Grid const grid = flow.grid;
    Vec3 force;
    for (int axis = 0; axis < 3; ++axis) {
        FieldView const face_force = solver.face_force.component[axis];
        force[axis] = reproducible_sums<1>(
            solver.sums, "boundary_force", face_slots(grid), KOKKOS_LAMBDA(int f) {
                Node const face = face_of_slot(grid, f);
                Real const volume = control_volume(grid, axis, face);
                return Terms<1>{volume > 0 ? volume * at(face_force, face) : 0};
            })[0];
    }
    return force;
}

} // namespace arenite
