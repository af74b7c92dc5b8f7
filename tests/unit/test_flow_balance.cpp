// SPDX-License-Identifier: MIT
// Exchange of momentum closes to rounding, whatever the tolerances of the solvers.
#include "apps/verify/fluid_case.hpp"
#include "fluid/flow_balance.hpp"

#include <gtest/gtest.h>

using namespace arenite;

namespace {

Real wave(Vec3 x, Real phase)
{
    return std::sin(900 * x.x + phase) * std::cos(1100 * x.y - phase) + std::sin(700 * x.z + 2 * phase);
}

FluidCase make_busy_case(bool periodic)
{
    FluidSettings settings = box_settings({6, 5, 7}, {6e-3, 5e-3, 7e-3});
    if (periodic)
        for (int axis = 0; axis < 3; ++axis) add_periodic_axis(settings, axis);
    else {
        settings.patches.push_back(face_patch(Face::y_lower, PatchKind::velocity, {0, 1e-3, 0}));
        settings.patches.push_back(face_patch(Face::z_upper, PatchKind::pressure));
    }
    settings.convection = ConvectionScheme::limited;
    settings.body_force = {30, -20, -9800};
    settings.pressure_tolerance = 1e-4; // loose on purpose
    FluidCase c = make_fluid_case(settings, true);
    c.solver.velocity_limits.relative = 1e-3;
    Grid const& grid = c.flow.grid;
    set_field(grid, c.flow.porosity, -1, [](Vec3 x) { return 0.6 + 0.15 * wave(x, 0.3); });
    set_field(grid, c.flow.porosity_previous, -1, [](Vec3 x) { return 0.6 + 0.15 * wave(x, 0.3); });
    set_field(grid, c.flow.drag, -1, [](Vec3 x) { return 1e5 * (2 + wave(x, 1)); });
    for (int axis = 0; axis < 3; ++axis) {
        set_field(grid, c.flow.velocity[axis], axis, [=](Vec3 x) { return 1e-2 * wave(x, axis); });
        set_field(grid, c.flow.drag_velocity[axis], -1, [=](Vec3 x) { return 1e3 * wave(x, 5 + axis); });
    }
    return c;
}

struct GrainShare {
    Vec3 stress, drag; // N on the grains: (1 - n) F and B u - b, summed over the cells
    Real size = 0;     // N, of what is added up
};

GrainShare share_of_grains(FluidCase& c)
{
    FaceField const force = make_face_field(c.flow.grid, "cell_force");
    fill_stress_force(c.flow, c.solver, force);
    HostField const n = host_copy(c.flow.porosity), drag = host_copy(c.flow.drag);
    GrainShare share;
    for (int axis = 0; axis < 3; ++axis) {
        HostField const f = host_copy(force.component[axis]), u = host_copy(c.flow.velocity[axis]),
                        b = host_copy(c.flow.drag_velocity[axis]);
        for (int k = 0; k < c.flow.grid.cells[2]; ++k)
            for (int j = 0; j < c.flow.grid.cells[1]; ++j)
                for (int i = 0; i < c.flow.grid.cells[0]; ++i) {
                    Real const volume = c.flow.grid.cell_volume();
                    Real const u_cell =
                        (value_of(u, i, j, k) + value_of(u, i + (axis == 0), j + (axis == 1), k + (axis == 2))) / 2;
                    Real const stress = (1 - value_of(n, i, j, k)) * value_of(f, i, j, k) * volume;
                    Real const slip = (value_of(drag, i, j, k) * u_cell - value_of(b, i, j, k)) * volume;
                    share.stress[axis] += stress;
                    share.drag[axis] += slip;
                    share.size += std::fabs(stress) + std::fabs(slip);
                }
    }
    return share;
}

// Change of the fluid's momentum = dt (boundary + body force on the fluid - what the grains get): in a
// periodic box nothing else acts, convection included.
TEST(FlowBalance, MomentumClosesToRoundingInAPeriodicBox)
{
    FluidCase c = make_busy_case(true);
    fill_halos(c.flow, c.boundary); // the waves are not periodic
    Real const dt = 1e-4;
    for (int s = 0; s < 3; ++s) {
        Vec3 const before = fluid_totals(c.flow, c.solver.sums).momentum;
        c.step(dt);
        FluidTotals const after = fluid_totals(c.flow, c.solver.sums);
        GrainShare const grains = share_of_grains(c);
        Vec3 const boundary = boundary_force(c.flow, c.solver);
        for (int axis = 0; axis < 3; ++axis) {
            Real const gain = (after.momentum[axis] - before[axis]) / dt;
            Real const expected =
                boundary[axis] + after.volume * c.flow.body_force[axis] - grains.stress[axis] - grains.drag[axis];
            EXPECT_NEAR(gain, expected, 1e-12 * (grains.size + std::fabs(gain)));
        }
    }
}

// Without motion of the fluid's own (no convection, steady porosity) the same holds with walls, an inlet and
// an opening: what they do is in boundary_force.
TEST(FlowBalance, MomentumClosesWithBoundaries)
{
    FluidCase c = make_busy_case(false);
    c.solver.convection = ConvectionScheme::none;
    c.step(1e-4);
    Real const dt = 1e-4;
    Vec3 const before = fluid_totals(c.flow, c.solver.sums).momentum;
    c.step(dt);
    FluidTotals const after = fluid_totals(c.flow, c.solver.sums);
    GrainShare const grains = share_of_grains(c);
    Vec3 const boundary = boundary_force(c.flow, c.solver);
    for (int axis = 0; axis < 3; ++axis) {
        Real const gain = (after.momentum[axis] - before[axis]) / dt;
        Real const expected =
            boundary[axis] + after.volume * c.flow.body_force[axis] - grains.stress[axis] - grains.drag[axis];
        EXPECT_NEAR(gain, expected, 1e-12 * (grains.size + std::fabs(gain)));
    }
}

// F is -grad p + div tau: in a still fluid the weight per volume, whatever the porosity.
TEST(FlowBalance, StillFluidBuoysItsWeight)
{
    FluidSettings settings = box_settings({3, 3, 6}, {3e-3, 3e-3, 6e-3});
    settings.body_force = {0, 0, -9792.3};
    settings.porosity = 0.5;
    FluidCase c = make_fluid_case(settings, true);
    c.steps(5, 1e-3);
    FaceField const force = make_face_field(c.flow.grid, "cell_force");
    fill_stress_force(c.flow, c.solver, force);
    EXPECT_LT(errors_of(c.flow.grid, force.component[2], -1, [](Vec3) { return 9792.3; }).largest, 1e-6);
    EXPECT_LT(errors_of(c.flow.grid, force.component[0], -1, [](Vec3) { return 0.0; }).largest, 1e-6);
}

} // namespace
