// SPDX-License-Identifier: MIT
// Manufactured steady solution of the averaged equations in the periodic unit square, porosity from 0.25 to
// 0.75, rho 1, mu 0.1, viscous form n div(tau):
//   n = 1/2 + sin(a x) sin(a y) / 4,   n (u, v) = (curl of a stream function + a constant),   p = sin(a y) cos(a x)
// The source is the residual of the momentum equation, by differences of the exact fields in long double.
#include "apps/verify/fluid_case.hpp"
#include "apps/verify/fluid_checks.hpp"

#include <fmt/format.h>

#include <map>

namespace arenite {
namespace {

using Wide = long double;
constexpr Wide a = 2 * 3.14159265358979323846264338327950288L;

Wide porosity(Wide x, Wide y) { return sinl(a * x) * sinl(a * y) / 4 + 0.5L; }
Wide pressure(Wide x, Wide y) { return sinl(a * y) * cosl(a * x); }
/// Components of n u: divergence-free.
Wide flux(int component, Wide x, Wide y)
{
    return component == 0 ? (3 - a * sinl(a * y) * cosl(a * x)) / 10 : (1 + a / 2 * sinl(a * x) * cosl(a * y)) / 5;
}
Wide velocity(int component, Wide x, Wide y) { return flux(component, x, y) / porosity(x, y); }

template <class F> Wide derivative(F const& f, int axis, Wide x, Wide y)
{
    constexpr Wide h = 1e-3L; // sixth order: error about h^6, rounding about 1e-19 / h
    auto const at = [&](Wide by) { return axis == 0 ? f(x + by, y) : f(x, y + by); };
    return (45 * (at(h) - at(-h)) - 9 * (at(2 * h) - at(-2 * h)) + at(3 * h) - at(-3 * h)) / (60 * h);
}

Wide stress(int c, int d, Wide x, Wide y)
{
    auto const u = [](int of) { return [of](Wide s, Wide t) { return velocity(of, s, t); }; };
    Wide const gradients = derivative(u(c), d, x, y) + derivative(u(d), c, x, y);
    Wide const divergence = derivative(u(0), 0, x, y) + derivative(u(1), 1, x, y);
    return 0.1L * (gradients - (c == d ? 2 * divergence / 3 : 0));
}

/// What has to be added to the right-hand side of component c.
Wide source(int c, Wide x, Wide y)
{
    Wide sum = porosity(x, y) * derivative(pressure, c, x, y);
    for (int d = 0; d < 2; ++d) {
        sum += derivative([&](Wide s, Wide t) { return flux(d, s, t) * velocity(c, s, t); }, d, x, y);
        sum -= porosity(x, y) * derivative([&](Wide s, Wide t) { return stress(c, d, s, t); }, d, x, y);
    }
    return sum;
}

struct Errors {
    Real velocity, pressure, continuity;
};

Errors run_manufactured(int n, ConvectionScheme scheme)
{
    FluidSettings settings = box_settings({n, n, 1}, {1, 1, 1.0 / n});
    for (int axis = 0; axis < 3; ++axis) add_periodic_axis(settings, axis);
    settings.density = 1;
    settings.viscosity = 0.1;
    settings.convection = scheme;
    FluidCase c = make_fluid_case(settings, true);
    Flow& flow = c.flow;
    set_field(flow.grid, flow.porosity, -1, [](Vec3 x) { return Real(porosity(x.x, x.y)); });
    Kokkos::deep_copy(flow.porosity_previous, flow.porosity);
    Kokkos::deep_copy(c.solver.porosity_oldest, flow.porosity);
    set_field(flow.grid, flow.pressure, -1, [](Vec3 x) { return Real(pressure(x.x, x.y)); });
    for (int axis = 0; axis < 2; ++axis) {
        std::map<std::pair<Real, Real>, Real> known; // the same in every layer
        auto const source_once = [&](Vec3 x) {
            auto const [entry, is_new] = known.try_emplace({x.x, x.y}, 0);
            if (is_new) entry->second = Real(source(axis, x.x, x.y));
            return entry->second;
        };
        set_field(flow.grid, flow.velocity[axis], axis, [&](Vec3 x) { return Real(velocity(axis, x.x, x.y)); });
        set_field(flow.grid, flow.drag_velocity[axis], -1, source_once);
    }
    Real const dt = 0.15 / n; // Courant number 0.4
    FlowReport const report = c.steps(int(1 / dt), dt);
    Errors errors{0, errors_of(flow.grid, flow.pressure, -1, [](Vec3 x) { return Real(pressure(x.x, x.y)); }).rms,
                  report.continuity_error / dt};
    for (int axis = 0; axis < 2; ++axis)
        errors.velocity += std::pow(
            errors_of(flow.grid, flow.velocity[axis], axis, [&](Vec3 x) { return Real(velocity(axis, x.x, x.y)); }).rms, 2);
    errors.velocity = std::sqrt(errors.velocity);
    return errors;
}

} // namespace

std::vector<VerifyCase> check_manufactured_flow()
{
    std::vector<VerifyCase> rows;
    std::string const symbolic = "computer algebra: mms_steady_points.csv, form A2";
    Wide const points[][4] = {{0.3L, 0.55L, 0.2020617891L, -3.16248992L}, {0.77L, 0.13L, -1.033829843L, -7.006002332L}};
    for (auto const& [x, y, sx, sy] : points)
        for (int c = 0; c < 2; ++c)
            rows.push_back(compare({fmt::format("F5 source at ({}, {})", Real(x), Real(y)),
                                    c == 0 ? "x component [Pa/m]" : "y component [Pa/m]", symbolic},
                                   Real(source(c, x, y)), Real(c == 0 ? sx : sy), 1e-8));
    for (ConvectionScheme const scheme : {ConvectionScheme::central, ConvectionScheme::limited}) {
        Errors const coarse = run_manufactured(12, scheme), fine = run_manufactured(24, scheme),
                     finest = run_manufactured(48, scheme);
        bool const central = scheme == ConvectionScheme::central;
        std::string const name = fmt::format("F5 manufactured flow, {} convection", central ? "central" : "limited"),
                          reference = "exact field; n from 0.25 to 0.75";
        Real const least = central ? 1.9 : 1.5; // the limiter is first order at extrema
        rows.push_back(compare_error({name + ", 48^2", "rms error of u / 2 m/s", reference}, finest.velocity / 2,
                                     central ? 5e-3 : 1e-2));
        rows.push_back(
            at_least({name, "order of u, 12 to 24", reference}, observed_order(coarse.velocity, fine.velocity), least));
        rows.push_back(
            at_least({name, "order of u, 24 to 48", reference}, observed_order(fine.velocity, finest.velocity), least));
        rows.push_back(
            at_least({name, "order of p, 24 to 48", reference}, observed_order(fine.pressure, finest.pressure), 1.5));
        // Rounding of 1e-16 over a spacing of 1/48, velocities up to 2.
        rows.push_back(compare_error({name + ", 48^2", "dn/dt + div(n u) [1/s]", "continuity"}, finest.continuity, 1e-11));
    }
    return rows;
}

} // namespace arenite
