// SPDX-License-Identifier: MIT
#include "apps/verify/fluid_case.hpp"
#include "core/error.hpp"
#include "fluid/patch_area.hpp"

#include <gtest/gtest.h>

using namespace arenite;

namespace {

constexpr Real pi = 3.14159265358979323846;

TEST(PatchArea, DiscSharesSumToItsArea)
{
    Real const center[2] = {0.3713, 0.5221}, radius = 0.2931;
    for (int const n : {1, 3, 12, 64}) {
        Real sum = 0;
        for (int b = 0; b < n; ++b)
            for (int a = 0; a < n; ++a)
                sum +=
                    disc_area_in_rectangle(center, radius, {{Real(a) / n, Real(b) / n}, {Real(a + 1) / n, Real(b + 1) / n}});
        EXPECT_NEAR(sum, pi * radius * radius, 1e-14);
    }
}

TEST(PatchArea, AgreesWithCountingPoints)
{
    Real const center[2] = {0.1, -0.2}, radius = 1;
    FaceRectangle const faces[] = {{{0, 0}, {0.7, 0.9}},
                                   {{-1.2, -1.5}, {-0.3, 0.2}},
                                   {{0.5, -2}, {0.8, 2}},
                                   {{-0.2, -0.3}, {0.1, 0.1}},
                                   {{1, 1}, {2, 2}}};
    for (FaceRectangle const& face : faces) {
        int const n = 1000;
        int inside = 0;
        for (int b = 0; b < n; ++b)
            for (int a = 0; a < n; ++a) {
                Real const x = face.lower[0] + (a + 0.5) / n * (face.upper[0] - face.lower[0]) - center[0];
                Real const y = face.lower[1] + (b + 0.5) / n * (face.upper[1] - face.lower[1]) - center[1];
                inside += x * x + y * y < radius * radius;
            }
        Real const area = (face.upper[0] - face.lower[0]) * (face.upper[1] - face.lower[1]);
        EXPECT_NEAR(disc_area_in_rectangle(center, radius, face), area * inside / (n * n), 1e-3 * area);
    }
}

FluidSettings hole_settings()
{
    FluidSettings settings = box_settings({12, 12, 6}, {0.018, 0.018, 0.009});
    PatchSettings disc = face_patch(Face::z_upper, PatchKind::pressure, {}, 5);
    disc.shape = PatchShape::disc;
    disc.center = {0.009, 0.009, 0};
    disc.diameter = 0.0026;
    settings.patches.push_back(disc);
    return settings;
}

TEST(FlowBoundary, PressureDiscOpensItsTrueArea)
{
    FluidSettings const settings = hole_settings();
    Flow const flow = make_flow(settings, *settings.box, false, {});
    FlowBoundary const boundary = make_boundary(settings, flow.grid);
    auto const faces = Kokkos::create_mirror_view(boundary.faces[2][1]);
    Kokkos::deep_copy(faces, boundary.faces[2][1]);
    Real area = 0;
    int open = 0;
    for (int b = 0; b < 12; ++b)
        for (int a = 0; a < 12; ++a) {
            area += faces(a, b).open * flow.grid.face_area(2);
            open += faces(a, b).open > 0;
            if (faces(a, b).open > 0) { EXPECT_NEAR(faces(a, b).pressure, 5, 1e-14); }
            EXPECT_NEAR(faces(a, b).stick, 1 - faces(a, b).open, 1e-15); // the rest of a cut face is wall
        }
    EXPECT_EQ(open, 4);
    EXPECT_NEAR(area, pi * 0.0026 * 0.0026 / 4, 1e-14 * area);
    EXPECT_TRUE(boundary.has_pressure);
}

TEST(FlowBoundary, LaterPatchLiesOverEarlierOne)
{
    FluidSettings settings = hole_settings();
    settings.patches.push_back(face_patch(Face::z_upper, PatchKind::wall));
    Flow const flow = make_flow(settings, *settings.box, false, {});
    EXPECT_FALSE(make_boundary(settings, flow.grid).has_pressure);
}

TEST(FlowBoundary, RefusesWhatMakesNoSense)
{
    FluidSettings lone = box_settings({4, 4, 4}, {1, 1, 1});
    lone.patches.push_back(face_patch(Face::x_lower, PatchKind::periodic));
    EXPECT_THROW(make_flow(lone, *lone.box, false, {}), InputError);

    FluidSettings unbalanced = box_settings({4, 4, 4}, {1, 1, 1});
    unbalanced.patches.push_back(face_patch(Face::x_lower, PatchKind::velocity, {0.1, 0, 0}));
    Flow const flow = make_flow(unbalanced, *unbalanced.box, false, {});
    EXPECT_THROW(make_boundary(unbalanced, flow.grid), InputError);
    unbalanced.patches.push_back(face_patch(Face::x_upper, PatchKind::velocity, {0.1, 0, 0}));
    EXPECT_NO_THROW(make_boundary(unbalanced, flow.grid));

    FluidSettings piston = box_settings({4, 4, 4}, {1, 1, 1});
    piston.patches.push_back(face_patch(Face::x_lower, PatchKind::wall, {0.1, 0, 0}));
    EXPECT_THROW(make_boundary(piston, flow.grid), InputError);
}

// Half way between the halo's value and the first cell's lies the wall's velocity; a slip wall copies.
TEST(FlowBoundary, HaloMirrorsThroughTheWall)
{
    FluidSettings settings = box_settings({4, 4, 4}, {1, 1, 1});
    settings.patches.push_back(face_patch(Face::y_upper, PatchKind::wall, {3, 0, 0}));
    settings.patches.push_back(face_patch(Face::y_lower, PatchKind::slip));
    add_periodic_axis(settings, 2);
    FluidCase c = make_fluid_case(settings, false);
    auto const profile = [](Vec3 x) { return 1 + x.y + std::sin(x.x); };
    set_field(c.flow.grid, c.flow.velocity[0], 0, profile);
    fill_halos(c.flow, c.boundary);
    HostField const u = host_copy(c.flow.velocity[0]);
    for (int i = 0; i <= 4; ++i) {
        EXPECT_NEAR((value_of(u, i, 3, 1) + value_of(u, i, 4, 1)) / 2, 3, 1e-14);
        EXPECT_EQ(value_of(u, i, -1, 1), value_of(u, i, 0, 1));
        EXPECT_EQ(value_of(u, i, 2, -1), value_of(u, i, 2, 3));
    }
    EXPECT_NEAR(value_of(u, -1, 2, 1), 2 * value_of(u, 0, 2, 1) - value_of(u, 1, 2, 1), 1e-14);
}

/// The step that finds the first pressure is without viscosity: a push over 10 000 s makes 1000 m/s, whose rounding is no
/// fault of the box.
TEST(FlowBoundary, PeriodicBoxTakesAStepOfAnyLength)
{
    FluidSettings settings = box_settings({16, 16, 1}, {1e-3, 1e-3, 6e-5});
    add_periodic_axis(settings, 0);
    add_periodic_axis(settings, 2);
    settings.body_force = {100, 0, 0};
    FluidCase c = make_fluid_case(settings, false);
    for (FieldView const& field : {c.flow.porosity, c.flow.porosity_previous})
        set_field(c.flow.grid, field, -1, [](Vec3 x) { return 0.6 + 0.2 * std::sin(2 * pi * x.x / 1e-3 + 0.1); });
    FlowReport report;
    EXPECT_NO_THROW(report = c.steps(3, 1e4));
    EXPECT_TRUE(report.converged());
}

TEST(FlowBoundary, ClosedBoxThatGainsPorosityStops)
{
    FluidSettings settings = box_settings({4, 4, 4}, {1, 1, 1});
    settings.porosity = 0.5;
    FluidCase c = make_fluid_case(settings, false);
    Kokkos::deep_copy(c.flow.porosity, 0.6);
    EXPECT_THROW(c.step(1e-3), SimulationError);
}

} // namespace
