// SPDX-License-Identifier: MIT
// Taylor-Green vortices, [0, 2 pi]^2 periodic: u = cos x sin y e^(-2 nu t), v = -sin x cos y e^(-2 nu t),
// p = -rho/4 (cos 2x + cos 2y) e^(-4 nu t). Order in space (dt follows the spacing) and, apart, in time.
#include "apps/verify/fluid_case.hpp"
#include "apps/verify/fluid_checks.hpp"

#include <fmt/format.h>

#include <numbers>

namespace arenite {
namespace {

constexpr Real length = 2 * std::numbers::pi_v<Real>;

struct VortexErrors {
    Real velocity, pressure, energy_ratio, divergence;
    bool converged;
};

Real kinetic_energy(FluidCase const& c)
{
    HostField const u = host_copy(c.flow.velocity[0]), v = host_copy(c.flow.velocity[1]);
    Real sum = 0;
    for (int j = 0; j < c.flow.grid.cells[1]; ++j)
        for (int i = 0; i < c.flow.grid.cells[0]; ++i)
            sum += std::pow(value_of(u, i, j, 0), 2) + std::pow(value_of(v, i, j, 0), 2);
    return sum;
}

FluidCase make_vortex_box(int n, Real nu, bool with_grains)
{
    FluidSettings settings = box_settings({n, n, 1}, {length, length, length / n});
    for (int axis = 0; axis < 3; ++axis) add_periodic_axis(settings, axis);
    settings.density = 1;
    settings.viscosity = nu;
    settings.convection = ConvectionScheme::central;
    settings.pressure_tolerance = 1e-12;
    return make_fluid_case(settings, with_grains);
}

VortexErrors run_vortices(int n, int steps, Real nu)
{
    FluidCase c = make_vortex_box(n, nu, false);
    auto const u = [&](Real t) { return [=](Vec3 x) { return std::cos(x.x) * std::sin(x.y) * std::exp(-2 * nu * t); }; };
    auto const v = [&](Real t) { return [=](Vec3 x) { return -std::sin(x.x) * std::cos(x.y) * std::exp(-2 * nu * t); }; };
    auto const p = [&](Real t) {
        return [=](Vec3 x) { return -(std::cos(2 * x.x) + std::cos(2 * x.y)) / 4 * std::exp(-4 * nu * t); };
    };
    set_field(c.flow.grid, c.flow.velocity[0], 0, u(0));
    set_field(c.flow.grid, c.flow.velocity[1], 1, v(0));
    set_field(c.flow.grid, c.flow.pressure, -1, p(0));
    Real const energy = kinetic_energy(c), dt = 1.0 / steps;
    FlowReport const report = c.steps(steps, dt);
    Real const eu = errors_of(c.flow.grid, c.flow.velocity[0], 0, u(1)).rms;
    Real const ev = errors_of(c.flow.grid, c.flow.velocity[1], 1, v(1)).rms;
    return {std::hypot(eu, ev), errors_of(c.flow.grid, c.flow.pressure, -1, p(1)).rms, kinetic_energy(c) / energy,
            report.continuity_error / dt, report.converged()};
}

} // namespace

std::vector<VerifyCase> check_vortices()
{
    std::vector<VerifyCase> rows;
    for (Real const nu : {0.01, 0.1}) {
        VortexErrors const coarse = run_vortices(16, 20, nu), fine = run_vortices(32, 40, nu),
                           finest = run_vortices(64, 80, nu);
        std::string const name = fmt::format("F2 Taylor-Green, nu {}, t 1", nu), source = "Taylor & Green 1937";
        rows.push_back(compare_error({name + ", 64^2", "rms error of u [m/s]", source}, finest.velocity, 1e-3));
        rows.push_back(compare_error({name + ", 64^2", "rms error of p [Pa]", source}, finest.pressure, 1e-3));
        rows.push_back(
            at_least({name, "order of u in space, 16 to 32", source}, observed_order(coarse.velocity, fine.velocity), 1.9));
        rows.push_back(
            at_least({name, "order of u in space, 32 to 64", source}, observed_order(fine.velocity, finest.velocity), 1.9));
        rows.push_back(
            at_least({name, "order of p in space, 32 to 64", source}, observed_order(fine.pressure, finest.pressure), 1.9));
        rows.push_back(compare({name + ", 64^2", "energy at the end / at the start", source}, finest.energy_ratio,
                               std::exp(-4 * nu), 5e-4));
        rows.push_back(compare_error({name + ", 64^2", "div u [1/s]", "continuity"}, finest.divergence, 1e-12));
        rows.push_back(
            expect_true({name, "every solve converged", "solver"}, coarse.converged && fine.converged && finest.converged));
    }
    return rows;
}

namespace {

HostField end_velocity(bool with_grains, int steps)
{
    FluidCase c = make_vortex_box(16, 0.1, with_grains);
    set_field(c.flow.grid, c.flow.velocity[0], 0, [](Vec3 x) { return 1 + std::cos(x.x) * std::sin(x.y); });
    set_field(c.flow.grid, c.flow.velocity[1], 1, [](Vec3 x) { return 1 - std::sin(x.x) * std::cos(x.y); });
    c.steps(steps, 1.0 / steps);
    return host_copy(c.flow.velocity[0]);
}

} // namespace

std::vector<VerifyCase> check_order_in_time()
{
    std::vector<VerifyCase> rows;
    for (bool const with_grains : {false, true}) {
        // Against the same grid with a step that is small enough, so that only the error in time is left.
        HostField const exact = end_velocity(with_grains, 640);
        auto const error = [&](int steps) {
            HostField const u = end_velocity(with_grains, steps);
            Real sum = 0;
            for (int j = 0; j < 16; ++j)
                for (int i = 0; i < 16; ++i) sum += std::pow(value_of(u, i, j, 0) - value_of(exact, i, j, 0), 2);
            return std::sqrt(sum / 256);
        };
        Real const coarse = error(20), fine = error(40), finest = error(80);
        std::string const name = with_grains ? "F10 carried vortices, implicit Euler (with grains)"
                                             : "F10 carried vortices, BDF2 (a fluid alone)",
                          source = "640 steps on the same grid";
        Real const order = with_grains ? 1 : 2;
        rows.push_back(compare({name, "order in time, 20 to 40 steps", source}, observed_order(coarse, fine), order,
                               with_grains ? 0.1 : 0.075));
        rows.push_back(compare({name, "order in time, 40 to 80 steps", source}, observed_order(fine, finest), order,
                               with_grains ? 0.1 : 0.05));
    }
    return rows;
}

} // namespace arenite
