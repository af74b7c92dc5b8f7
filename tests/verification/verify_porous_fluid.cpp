// SPDX-License-Identifier: MIT
// A cell that empties in one step, and a disc with a prescribed velocity on cut faces; what has a closed form
// of its own runs as `arenite verify fluid`.
#include "apps/verify/fluid_case.hpp"

#include <gtest/gtest.h>

using namespace arenite;

namespace {

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
