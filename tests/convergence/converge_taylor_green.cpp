// SPDX-License-Identifier: MIT
// Taylor-Green vortices, [0, 2 pi]^2 periodic: u = cos x sin y e^(-2 nu t), v = -sin x cos y e^(-2 nu t),
// p = -rho/4 (cos 2x + cos 2y) e^(-4 nu t). Order in space (dt follows the spacing) and in time.
#include "tests/fluid_tools.hpp"

#include <gtest/gtest.h>

using namespace arenite;

namespace
{

constexpr Real length = 2 * 3.14159265358979323846;

struct VortexErrors {
    Real velocity, pressure, energy, divergence;
};

Real kinetic_energy(FluidCase& c)
{
    HostField const u = host_copy(c.flow.velocity[0]), v = host_copy(c.flow.velocity[1]);
    Real sum = 0;
    for (int j = 0; j < c.flow.grid.cells[1]; ++j)
        for (int i = 0; i < c.flow.grid.cells[0]; ++i)
            sum += std::pow(value_of(u, i, j, 0), 2) + std::pow(value_of(v, i, j, 0), 2);
    return sum;
}

VortexErrors run_vortices(int n, int steps, Real nu, bool with_grains)
{
    FluidSettings settings = box_settings({n, n, 1}, {length, length, length / n});
    for (int axis = 0; axis < 3; ++axis) add_periodic_axis(settings, axis);
    settings.density = 1;
    settings.viscosity = nu;
    settings.convection = ConvectionScheme::central;
    settings.pressure_tolerance = 1e-12;
    FluidCase c = make_fluid_case(settings, with_grains);
    auto const u = [&](Real t) {
        return [=](Vec3 x) { return std::cos(x.x) * std::sin(x.y) * std::exp(-2 * nu * t); };
    };
    auto const v = [&](Real t) {
        return [=](Vec3 x) { return -std::sin(x.x) * std::cos(x.y) * std::exp(-2 * nu * t); };
    };
    auto const p = [&](Real t) {
        return [=](Vec3 x) { return -(std::cos(2 * x.x) + std::cos(2 * x.y)) / 4 * std::exp(-4 * nu * t); };
    };
    set_field(c.flow.grid, c.flow.velocity[0], 0, u(0));
    set_field(c.flow.grid, c.flow.velocity[1], 1, v(0));
    set_field(c.flow.grid, c.flow.pressure, -1, p(0));
    Real const energy = kinetic_energy(c), dt = 1.0 / steps;
    FlowReport const report = c.steps(steps, dt);
    EXPECT_TRUE(report.converged);
    Real const eu = errors_of(c.flow.grid, c.flow.velocity[0], 0, u(1)).rms;
    Real const ev = errors_of(c.flow.grid, c.flow.velocity[1], 1, v(1)).rms;
    return {std::hypot(eu, ev), errors_of(c.flow.grid, c.flow.pressure, -1, p(1)).rms,
            std::fabs(kinetic_energy(c) / energy - std::exp(-4 * nu)), report.continuity_error / dt};
}

TEST(TaylorGreen, SecondOrderInSpace)
{
    for (Real const nu : {0.01, 0.1}) {
        VortexErrors const coarse = run_vortices(16, 20, nu, false), fine = run_vortices(32, 40, nu, false),
                           finest = run_vortices(64, 80, nu, false);
        printf("nu %g: u %.3e %.3e %.3e  p %.3e %.3e %.3e  energy %.3e  div %.1e\n", nu, coarse.velocity, fine.velocity,
               finest.velocity, coarse.pressure, fine.pressure, finest.pressure, finest.energy, finest.divergence);
        EXPECT_GE(observed_order(coarse.velocity, fine.velocity), 1.9);
        EXPECT_GE(observed_order(fine.velocity, finest.velocity), 1.9);
        EXPECT_GE(observed_order(fine.pressure, finest.pressure), 1.9);
        EXPECT_LT(finest.energy, 3e-4);
        EXPECT_LT(finest.divergence, 1e-12);
    }
}

// Against the same grid with a step that is small enough, so that only the error in time is left.
void expect_order_in_time(bool with_grains, Real low, Real high)
{
    auto const end_field = [&](int steps) {
        FluidSettings settings = box_settings({16, 16, 1}, {length, length, length / 16});
        for (int axis = 0; axis < 3; ++axis) add_periodic_axis(settings, axis);
        settings.density = 1;
        settings.viscosity = 0.1;
        settings.convection = ConvectionScheme::central;
        settings.pressure_tolerance = 1e-12;
        FluidCase c = make_fluid_case(settings, with_grains);
        set_field(c.flow.grid, c.flow.velocity[0], 0, [](Vec3 x) { return 1 + std::cos(x.x) * std::sin(x.y); });
        set_field(c.flow.grid, c.flow.velocity[1], 1, [](Vec3 x) { return 1 - std::sin(x.x) * std::cos(x.y); });
        c.steps(steps, 1.0 / steps);
        return host_copy(c.flow.velocity[0]);
    };
    HostField const exact = end_field(640);
    auto const error = [&](int steps) {
        HostField const u = end_field(steps);
        Real sum = 0;
        for (int j = 0; j < 16; ++j)
            for (int i = 0; i < 16; ++i) sum += std::pow(value_of(u, i, j, 0) - value_of(exact, i, j, 0), 2);
        return std::sqrt(sum / 256);
    };
    Real const coarse = error(20), fine = error(40), finest = error(80);
    printf("time: %.3e %.3e %.3e\n", coarse, fine, finest);
    EXPECT_GT(observed_order(fine, finest), low);
    EXPECT_LT(observed_order(fine, finest), high);
    EXPECT_GT(observed_order(coarse, fine), low);
}

TEST(TaylorGreen, SecondOrderInTimeForAFluidAlone) { expect_order_in_time(false, 1.9, 2.15); }
TEST(TaylorGreen, FirstOrderInTimeWithGrains) { expect_order_in_time(true, 0.9, 1.1); }

} // namespace
