// SPDX-License-Identifier: MIT
// Flows along one direction with closed forms: Poiseuille and Brinkman channels, the relaxation of a
// uniform flow by drag, and Darcy columns; for steps of any length.
#include "fluid/flow_balance.hpp"
#include "tests/fluid_tools.hpp"

#include <gtest/gtest.h>

using namespace arenite;

namespace
{

constexpr Real height = 1e-3, push = 100; // m, Pa/m

FluidCase make_channel(int cells, Real porosity, Real drag)
{
    Real const h = height / cells;
    FluidSettings settings = box_settings({2, cells, 1}, {2 * h, height, h});
    add_periodic_axis(settings, 0);
    add_periodic_axis(settings, 2);
    settings.porosity = porosity;
    settings.body_force = {push, 0, 0};
    FluidCase c = make_fluid_case(settings, true);
    Kokkos::deep_copy(c.flow.drag, drag);
    return c;
}

/// n mu u'' - B u + n push = 0, u = 0 at the walls.
Real channel_velocity(Real y, Real porosity, Real drag)
{
    Real const mu = 1e-3;
    if (drag == 0) return push / (2 * mu) * y * (height - y);
    Real const lambda = std::sqrt(drag / (porosity * mu)), from_centre = std::fabs(y - height / 2);
    Real const ratio = std::exp(lambda * (from_centre - height / 2)) * (1 + std::exp(-2 * lambda * from_centre)) /
                       (1 + std::exp(-lambda * height)); // cosh over cosh without overflow
    return porosity * push / drag * (1 - ratio);
}

FieldErrors channel_errors(int cells, Real porosity, Real drag)
{
    FluidCase c = make_channel(cells, porosity, drag);
    c.steps(12, 1e4); // the steady state, by steps far beyond every time of the problem
    return errors_of(c.flow.grid, c.flow.velocity[0], 0, [&](Vec3 x) { return channel_velocity(x.y, porosity, drag); });
}

TEST(Channel, PoiseuilleDoesNotDependOnPorosity)
{
    for (Real const n : {1.0, 0.41}) {
        Real const coarse = channel_errors(16, n, 0).largest, fine = channel_errors(32, n, 0).largest;
        EXPECT_LT(fine, 1e-3 * 0.05);
        EXPECT_GE(observed_order(coarse, fine), 1.9);
    }
}

TEST(Channel, BrinkmanIsSecondOrder)
{
    struct Bed {
        Real drag;
        int cells;
    };
    for (Bed const bed : {Bed{1e5, 64}, Bed{1e6, 200}}) { // 4, then 8 cells per 1/lambda
        Real const largest = 0.41 * push / bed.drag;
        FieldErrors const coarse = channel_errors(bed.cells, 0.41, bed.drag),
                          fine = channel_errors(2 * bed.cells, 0.41, bed.drag);
        printf("Brinkman B %g: rms %.2e %.2e, at the wall %.2e %.2e of the largest velocity\n", bed.drag,
               coarse.rms / largest, fine.rms / largest, coarse.largest / largest, fine.largest / largest);
        EXPECT_LT(fine.rms, 1e-3 * largest);
        EXPECT_GE(observed_order(coarse.rms, fine.rms), 1.9);
    }
}

TEST(Channel, UnresolvedBrinkmanLayerStaysMonotone)
{
    FluidCase c = make_channel(32, 0.41, 1e7);
    c.steps(12, 1e-3);
    HostField const u = host_copy(c.flow.velocity[0]);
    for (int j = 1; j < 16; ++j) EXPECT_GE(value_of(u, 0, j, 0), value_of(u, 0, j - 1, 0) * (1 - 1e-12));
    EXPECT_NEAR(value_of(u, 0, 16, 0), 4.1e-6, 1e-9);
}

TEST(Channel, WallsTakeTheWholePush)
{
    FluidCase c = make_channel(16, 1, 0);
    c.steps(12, 1e4);
    Real const volume = c.flow.grid.cell_count() * c.flow.grid.cell_volume();
    EXPECT_NEAR(boundary_force(c.flow, c.solver).x, -push * volume, 1e-9 * push * volume);
}

// Implicit Euler: u_new = (u + dt push / rho) / (1 + dt B / (rho n)), for any step.
TEST(UniformFlow, RelaxesByDragForAnyStep)
{
    for (Real const dt : {1e-6, 1e-4, 1e-2, 1.0})
        for (Real const drag : {0.0, 1e3, 1e5, 1e7}) {
            FluidSettings settings = box_settings({4, 3, 2}, {4e-3, 3e-3, 2e-3});
            for (int axis = 0; axis < 3; ++axis) add_periodic_axis(settings, axis);
            settings.porosity = 0.41;
            settings.initial_velocity = {0.01, -0.02, 0.03};
            settings.body_force = {push, 0, 0};
            FluidCase c = make_fluid_case(settings, true);
            Kokkos::deep_copy(c.flow.drag, drag);
            Real expected = 0.01;
            for (int s = 0; s < 5; ++s) {
                c.step(dt);
                expected = (expected + dt * push / 998.2) / (1 + dt * drag / (998.2 * 0.41));
                Real const error =
                    errors_of(c.flow.grid, c.flow.velocity[0], 0, [&](Vec3) { return expected; }).largest;
                ASSERT_LT(error, 1e-12 * std::fabs(expected));
            }
            if (drag >= 1e5 && dt == 1.0) { EXPECT_NEAR(expected, 0.41 * push / drag, 1e-9 * expected); }
        }
}

TEST(UniformFlow, FollowsGrainsThatMoveTogether)
{
    FluidSettings settings = box_settings({4, 4, 4}, {4e-3, 4e-3, 4e-3});
    for (int axis = 0; axis < 3; ++axis) add_periodic_axis(settings, axis);
    settings.porosity = 0.5;
    settings.convection = ConvectionScheme::limited;
    FluidCase c = make_fluid_case(settings, true);
    Kokkos::deep_copy(c.flow.drag, 1e6);
    Kokkos::deep_copy(c.flow.drag_velocity[1], 1e6 * 0.02);
    c.steps(10, 1e-2);
    EXPECT_LT(errors_of(c.flow.grid, c.flow.velocity[1], 1, [](Vec3) { return 0.02; }).largest, 1e-12);
}

// Superficial velocity U through a bed: -dp/dz = B U / n^2, in as few steps of whatever length.
TEST(Darcy, PressureGradientDoesNotDependOnTheStep)
{
    Real const U = 1e-4, n = 0.41, gradient = 1318.668, drag = gradient * n * n / U;
    for (Real const dt : {1e-6, 1e-3, 1.0, 1e3}) {
        FluidSettings settings = box_settings({2, 3, 9}, {2e-3, 3e-3, 9e-3});
        add_periodic_axis(settings, 0);
        for (Face const face : {Face::y_lower, Face::y_upper})
            settings.patches.push_back(face_patch(face, PatchKind::slip));
        settings.patches.push_back(face_patch(Face::z_lower, PatchKind::velocity, {0, 0, U}));
        settings.patches.push_back(face_patch(Face::z_upper, PatchKind::pressure, {}, 101325));
        settings.porosity = n;
        settings.initial_pressure = 101325;
        settings.initial_velocity = {0, 0, U / n};
        settings.pressure_tolerance = 1e-12;
        FluidCase c = make_fluid_case(settings, true);
        Kokkos::deep_copy(c.flow.drag, drag);
        FlowReport const report = c.steps(3, dt);
        auto const p = [&](Vec3 x) { return 101325 + gradient * (9e-3 - x.z); };
        EXPECT_LT(errors_of(c.flow.grid, c.flow.pressure, -1, p).largest, 1e-9 * 101325) << dt;
        EXPECT_LT(errors_of(c.flow.grid, c.flow.velocity[2], 2, [&](Vec3) { return U / n; }).largest, 1e-9 * U);
        EXPECT_NEAR(report.outflow, U * 6e-6, 1e-12 * U * 6e-6);
    }
}

TEST(Hydrostatics, FluidAtRestStaysAtRest)
{
    FluidSettings settings = box_settings({4, 4, 8}, {4e-3, 4e-3, 8e-3});
    settings.porosity = 0.41;
    settings.body_force = {0, 0, -998.2 * 9.81};
    settings.convection = ConvectionScheme::limited;
    FluidCase c = make_fluid_case(settings, true);
    set_field(c.flow.grid, c.flow.drag, -1, [](Vec3 x) { return x.z > 4e-3 ? 1e6 : 1e3; });
    set_field(c.flow.grid, c.flow.porosity, -1, [](Vec3 x) { return x.z > 4e-3 ? 0.41 : 0.9; });
    Kokkos::deep_copy(c.flow.porosity_previous, c.flow.porosity);
    c.steps(20, 1e-5);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_LT(errors_of(c.flow.grid, c.flow.velocity[axis], axis, [](Vec3) { return 0.0; }).largest, 1e-12);
    HostField const p = host_copy(c.flow.pressure);
    EXPECT_NEAR(value_of(p, 1, 1, 0) - value_of(p, 1, 1, 7), 998.2 * 9.81 * 7e-3, 1e-6);
}

} // namespace
