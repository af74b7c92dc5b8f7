// SPDX-License-Identifier: MIT
// Lid-driven cavity at Re 100 against Ghia, Ghia & Shin, J. Comput. Phys. 48 (1982) 387, tables I and II.
#include "tests/fluid_tools.hpp"

#include <gtest/gtest.h>

using namespace arenite;

namespace
{

struct Point {
    Real at, velocity;
};
constexpr Point u_of_y[] = {{0.0547, -0.03717}, {0.1016, -0.06434}, {0.1719, -0.10150}, {0.2813, -0.15662},
                            {0.4531, -0.21090}, {0.5, -0.20581},    {0.6172, -0.13641}, {0.7344, 0.00332},
                            {0.8516, 0.23151},  {0.9531, 0.68717}};
constexpr Point v_of_x[] = {{0.0625, 0.09233}, {0.0938, 0.12317},  {0.1563, 0.16077},  {0.2266, 0.17507},
                            {0.5, 0.05454},    {0.8047, -0.24533}, {0.8594, -0.22445}, {0.9453, -0.10313}};

/// Value on the centre line at distance s along it, from the values at the centres of its cells.
Real interpolated(std::function<Real(int)> const& value, int n, Real s)
{
    int const low = std::min(std::max(int(s * n - 0.5), 0), n - 2);
    Real const t = s * n - 0.5 - low;
    return (1 - t) * value(low) + t * value(low + 1);
}

TEST(Cavity, AgreesWithGhiaAtReynolds100)
{
    int const n = 32;
    FluidSettings settings = box_settings({n, n, 1}, {1, 1, 1.0 / n});
    add_periodic_axis(settings, 2);
    settings.patches.push_back(face_patch(Face::y_upper, PatchKind::wall, {1, 0, 0}));
    settings.density = 1;
    settings.viscosity = 0.01;
    settings.convection = ConvectionScheme::central;
    settings.pressure_tolerance = 1e-6; // of each step's correction
    FluidCase c = make_fluid_case(settings, false);
    FlowReport const report = c.steps(800, 0.02);
    EXPECT_TRUE(report.converged);
    HostField const u = host_copy(c.flow.velocity[0]), v = host_copy(c.flow.velocity[1]);
    Real worst = 0;
    for (Point const& point : u_of_y)
        worst = std::fmax(worst, std::fabs(interpolated([&](int j) { return value_of(u, n / 2, j, 0); }, n, point.at) -
                                           point.velocity));
    for (Point const& point : v_of_x)
        worst = std::fmax(worst, std::fabs(interpolated([&](int i) { return value_of(v, i, n / 2, 0); }, n, point.at) -
                                           point.velocity));
    printf("cavity: largest error %.4f, flow through walls %.1e\n", worst, report.inflow);
    EXPECT_LT(worst, 0.012); // of the lid's speed, at 32 x 32; second order from there
    EXPECT_EQ(report.inflow + report.outflow, 0);
}

} // namespace
