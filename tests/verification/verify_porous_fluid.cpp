// SPDX-License-Identifier: MIT
// Porosity that jumps in space, moves in time, or empties in one step; holes with cut faces.
#include "fluid/operators.hpp"
#include "tests/fluid_tools.hpp"

#include <gtest/gtest.h>

using namespace arenite;

namespace
{

constexpr Real U = 1e-4; // superficial velocity, m/s

/// Column along z with an inlet below and an opening above, free of shear at its sides.
FluidSettings column_settings(int cells)
{
    Real const h = 18e-3 / cells;
    FluidSettings settings = box_settings({1, 1, cells}, {h, h, 18e-3});
    add_periodic_axis(settings, 0);
    add_periodic_axis(settings, 1);
    settings.patches.push_back(face_patch(Face::z_lower, PatchKind::velocity, {0, 0, U}));
    settings.patches.push_back(face_patch(Face::z_upper, PatchKind::pressure));
    settings.convection = ConvectionScheme::limited;
    return settings;
}

struct Bed {
    Real porosity, gradient; // -, Pa/m at U
};

Real drag_of(Bed const& bed) { return bed.gradient * bed.porosity * bed.porosity / U; }

/// Steady flow through `below` and, from half the height on, `above`; thick: cells of `above`, 0 to the top.
void expect_no_wiggles(Bed below, Bed above, int thick)
{
    int const cells = 24;
    FluidCase c = make_fluid_case(column_settings(cells), true);
    auto const is_above = [&](Vec3 x) {
        int const k = int(x.z / 18e-3 * cells);
        return k >= cells / 2 && (thick == 0 || k < cells / 2 + thick);
    };
    set_field(c.flow.grid, c.flow.porosity, -1, [&](Vec3 x) { return (is_above(x) ? above : below).porosity; });
    set_field(c.flow.grid, c.flow.drag, -1, [&](Vec3 x) { return drag_of(is_above(x) ? above : below); });
    Kokkos::deep_copy(c.flow.porosity_previous, c.flow.porosity);
    FlowReport const report = c.steps(30, 1e-2);
    EXPECT_LT(report.continuity_error, 1e-12);
    HostField const u = host_copy(c.flow.velocity[2]), p = host_copy(c.flow.pressure), n = host_copy(c.flow.porosity);
    Real const low = std::fmin(below.gradient, above.gradient), high = std::fmax(below.gradient, above.gradient);
    for (int k = 1; k < cells; ++k) {
        Real const face_porosity = (value_of(n, 0, 0, k) + value_of(n, 0, 0, k - 1)) / 2;
        EXPECT_NEAR(face_porosity * value_of(u, 0, 0, k), U, 1e-10 * U);
        Real const gradient = (value_of(p, 0, 0, k - 1) - value_of(p, 0, 0, k)) / c.flow.grid.spacing.z;
        constexpr Real overshoot = 1e-3;
        EXPECT_GE(gradient, low - overshoot * high) << k;
        EXPECT_LE(gradient, high + overshoot * high) << k;
    }
}

TEST(PorosityJump, NoOscillation)
{
    Bed const clear{1, 0}, dense{0.41, 1318.6683}, loose{0.60, 149.58775};
    expect_no_wiggles(clear, dense, 0);
    expect_no_wiggles(dense, clear, 0);
    expect_no_wiggles(dense, loose, 0);
    expect_no_wiggles(dense, clear, 1);
    expect_no_wiggles(clear, dense, 1);
}

TEST(MovingPorosity, MassClosesInEveryStep)
{
    FluidSettings settings = box_settings({6, 5, 8}, {6e-3, 5e-3, 8e-3});
    add_periodic_axis(settings, 0);
    settings.patches.push_back(face_patch(Face::z_upper, PatchKind::pressure));
    settings.convection = ConvectionScheme::limited;
    FluidCase c = make_fluid_case(settings, true);
    Kokkos::deep_copy(c.flow.drag, 1e5);
    Real const dt = 1e-4, volume = c.flow.grid.cell_volume();
    auto const porosity = [&](Real t) {
        return [=](Vec3 x) {
            return 0.6 + 0.2 * std::sin(900 * x.x + 50 * t) * std::cos(700 * x.z - 80 * t) +
                   0.1 * std::sin(200 * t) * x.z / 8e-3;
        };
    };
    set_field(c.flow.grid, c.flow.porosity, -1, porosity(0));
    Kokkos::deep_copy(c.flow.porosity_previous, c.flow.porosity);
    for (int s = 1; s <= 20; ++s) {
        HostField const before = host_copy(c.flow.porosity);
        set_field(c.flow.grid, c.flow.porosity, -1, porosity(s * dt));
        HostField const after = host_copy(c.flow.porosity);
        FlowReport const report = c.step(dt);
        Real gain = 0, throughput = 0;
        for (int k = 0; k < 8; ++k)
            for (int j = 0; j < 5; ++j)
                for (int i = 0; i < 6; ++i) {
                    Real const change = (value_of(after, i, j, k) - value_of(before, i, j, k)) * volume / dt;
                    gain += change;
                    throughput += std::fabs(change);
                }
        EXPECT_NEAR(gain, report.inflow - report.outflow, 1e-12 * throughput) << s;
        EXPECT_TRUE(report.converged);
    }
}

TEST(MovingPorosity, CellEmptiedInOneStepStaysBounded)
{
    FluidSettings settings = box_settings({5, 5, 5}, {7.5e-3, 7.5e-3, 7.5e-3});
    settings.patches.push_back(face_patch(Face::z_upper, PatchKind::pressure));
    settings.porosity = 0.4;
    settings.convection = ConvectionScheme::limited;
    FluidCase c = make_fluid_case(settings, true);
    Kokkos::deep_copy(c.flow.drag, 2e6);
    c.steps(2, 1e-4);
    Real const h = 1.5e-3, dt = 1e-4;
    auto const emptied = [=](Vec3 x) { return int(x.x / h) == 2 && int(x.y / h) == 2 && int(x.z / h) == 2; };
    set_field(c.flow.grid, c.flow.porosity, -1, [&](Vec3 x) { return emptied(x) ? 1.0 : 0.4; });
    set_field(c.flow.grid, c.flow.drag, -1, [&](Vec3 x) { return emptied(x) ? 0.0 : 2e6; });
    FlowReport const jump = c.step(dt), after = c.step(dt);
    EXPECT_NEAR(jump.inflow - jump.outflow, 0.6 * h * h * h / dt, 1e-11 * h * h * h / dt);
    EXPECT_LT(jump.courant, 1); // 0.6 cells of fluid through six faces of porosity 0.7
    EXPECT_LT(after.courant, 0.3 * jump.courant);
    EXPECT_LT(jump.continuity_error, 1e-8);
}

/// The seed's box: inflow through both y faces, holes of 2.6 mm at the top and at the bottom.
FluidSettings perforated_box()
{
    FluidSettings settings = box_settings({12, 12, 6}, {18e-3, 18e-3, 9e-3});
    add_periodic_axis(settings, 0);
    settings.porosity = 0.41;
    settings.initial_pressure = 101325;
    settings.patches.push_back(face_patch(Face::y_lower, PatchKind::velocity, {0, U, 0}));
    settings.patches.push_back(face_patch(Face::y_upper, PatchKind::velocity, {0, -U, 0}));
    for (Face const face : {Face::z_lower, Face::z_upper}) {
        PatchSettings hole = face_patch(face, PatchKind::pressure, {}, 101325);
        hole.shape = PatchShape::disc;
        hole.center = {9e-3, 9e-3, 0};
        hole.diameter = 2.6e-3;
        settings.patches.push_back(hole);
    }
    return settings;
}

TEST(Holes, TakeTheWholeInflowInEveryStep)
{
    for (Real const dt : {1e-6, 1e-2}) {
        FluidCase c = make_fluid_case(perforated_box(), true);
        Kokkos::deep_copy(c.flow.drag, 1250.6 * 0.41 * 0.41 / U);
        for (int s = 0; s < 10; ++s) {
            FlowReport const report = c.step(dt);
            EXPECT_TRUE(report.converged);
            EXPECT_NEAR(report.inflow, 3.24e-8, 1e-12 * 3.24e-8);
            EXPECT_NEAR(report.outflow, 3.24e-8, 1e-12 * 3.24e-8);
        }
        // Half through either hole: 3.05 mm/s over the hole's true area.
        HostField const w = host_copy(c.flow.velocity[2]);
        Real top = 0;
        for (int j = 0; j < 12; ++j)
            for (int i = 0; i < 12; ++i) top += 0.41 * value_of(w, i, j, 6) * c.flow.grid.face_area(2);
        EXPECT_NEAR(top / (3.14159265358979 * 1.3e-3 * 1.3e-3), 3.0513e-3, 1e-4 * 3.0513e-3);
    }
}

TEST(Holes, VelocityDiscDeliversItsExactFlux)
{
    FluidSettings settings = box_settings({9, 7, 5}, {9e-3, 7e-3, 5e-3});
    PatchSettings disc = face_patch(Face::x_lower, PatchKind::velocity, {0.01, 0, 0});
    disc.shape = PatchShape::disc;
    disc.center = {0, 3.1e-3, 2.7e-3};
    disc.diameter = 3.3e-3;
    settings.patches.push_back(disc);
    settings.patches.push_back(face_patch(Face::x_upper, PatchKind::pressure));
    settings.convection = ConvectionScheme::limited;
    FluidCase c = make_fluid_case(settings, false);
    FlowReport const report = c.steps(5, 1e-3);
    Real const flux = 0.01 * 3.14159265358979323846 * 3.3e-3 * 3.3e-3 / 4;
    EXPECT_NEAR(report.inflow - report.outflow, 0, 1e-12 * flux);
    EXPECT_NEAR(report.inflow, flux, 1e-8 * flux); // backflow through the opening would add to it
}

} // namespace
