// SPDX-License-Identifier: MIT
// Flows along one direction with closed forms: Poiseuille and Brinkman channels, the relaxation of a
// uniform flow by drag, Darcy columns, a fluid at rest; for steps of any length.
#include "apps/verify/fluid_case.hpp"
#include "apps/verify/fluid_checks.hpp"
#include "fluid/flow_balance.hpp"

#include <fmt/format.h>

namespace arenite {
namespace {

constexpr Real height = 1e-3, push = 100, water = 998.2, viscosity = 1e-3; // m, Pa/m, kg/m3, Pa s

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
    if (drag == 0) return push / (2 * viscosity) * y * (height - y);
    Real const lambda = std::sqrt(drag / (porosity * viscosity)), from_centre = std::fabs(y - height / 2);
    Real const ratio = std::exp(lambda * (from_centre - height / 2)) * (1 + std::exp(-2 * lambda * from_centre)) /
                       (1 + std::exp(-lambda * height)); // cosh over cosh without overflow
    return porosity * push / drag * (1 - ratio);
}

/// Over the largest velocity.
FieldErrors channel_errors(int cells, Real porosity, Real drag)
{
    FluidCase c = make_channel(cells, porosity, drag);
    c.steps(12, 1e4); // the steady state, by steps far beyond every time of the problem
    FieldErrors errors =
        errors_of(c.flow.grid, c.flow.velocity[0], 0, [&](Vec3 x) { return channel_velocity(x.y, porosity, drag); });
    Real const largest = channel_velocity(height / 2, porosity, drag);
    errors.rms /= largest;
    errors.largest /= largest;
    return errors;
}

} // namespace

std::vector<VerifyCase> check_channel()
{
    std::vector<VerifyCase> rows;
    for (Real const n : {1.0, 0.41}) {
        std::string const name = fmt::format("F3 Poiseuille, n {}", n), source = "closed form: does not depend on n";
        // The slope at a wall is a parabola's: exact here, but for the velocity solver's tolerance.
        rows.push_back(
            compare_error({name + ", 16 cells", "largest error / u_max", source}, channel_errors(16, n, 0).largest, 1e-7));
    }
    FluidCase poiseuille = make_channel(16, 1, 0);
    poiseuille.steps(12, 1e4);
    Real const volume = poiseuille.flow.grid.cell_count() * poiseuille.flow.grid.cell_volume();
    rows.push_back(compare({"F3 Poiseuille, n 1", "force on the walls / push", "closed form: the whole push"},
                           -boundary_force(poiseuille.flow, poiseuille.solver).x / (push * volume), 1, 1e-9));
    return rows;
}

std::vector<VerifyCase> check_brinkman()
{
    struct Bed {
        Real drag;
        int cells;
    };
    std::vector<VerifyCase> rows;
    for (Bed const bed : {Bed{1e5, 128}, Bed{1e6, 400}}) { // 8 cells per 1/lambda, then 16
        FieldErrors const coarse = channel_errors(bed.cells, 0.41, bed.drag),
                          fine = channel_errors(2 * bed.cells, 0.41, bed.drag);
        std::string const name = fmt::format("F3 Brinkman, n 0.41, B {:g}", bed.drag),
                          source = "closed form: n push/B (1 - cosh/cosh)";
        rows.push_back(compare_error({name + ", 8 cells per 1/lambda", "rms error / u_max", source}, coarse.rms, 1e-3));
        rows.push_back(
            compare_error({name + ", 8 cells per 1/lambda", "largest error / u_max", source}, coarse.largest, 1e-3));
        rows.push_back(
            at_least({name, "order of the rms error, 8 to 16 cells", source}, observed_order(coarse.rms, fine.rms), 1.85));
        rows.push_back(at_least({name, "order of the largest error, 8 to 16 cells", source},
                                observed_order(coarse.largest, fine.largest), 1.85));
    }
    FluidCase c = make_channel(32, 0.41, 1e7); // 1/lambda is a fifth of a cell
    c.steps(12, 1e-3);
    HostField const u = host_copy(c.flow.velocity[0]);
    Real fall = 0;
    for (int j = 1; j < 16; ++j) fall = std::fmax(fall, value_of(u, 0, j - 1, 0) - value_of(u, 0, j, 0));
    std::string const name = "F3 Brinkman, n 0.41, B 1e7, unresolved";
    rows.push_back(
        compare_error({name, "fall of u away from the wall / u_max", "closed form: monotone"}, fall / 4.1e-6, 1e-12));
    rows.push_back(compare({name, "u in the middle [m/s]", "closed form: n push/B"}, value_of(u, 0, 16, 0), 4.1e-6, 1e-3));
    return rows;
}

namespace {

FluidSettings periodic_box(Real porosity)
{
    FluidSettings settings = box_settings({4, 3, 2}, {4e-3, 3e-3, 2e-3});
    for (int axis = 0; axis < 3; ++axis) add_periodic_axis(settings, axis);
    settings.porosity = porosity;
    return settings;
}

/// Largest departure from u_new = (u + dt push / rho) / (1 + dt B / (rho n)) over five steps, relative, and the
/// last value over the steady one.
struct Relaxation {
    Real error = 0, end = 0;
};

Relaxation relax(Real drag, Real dt)
{
    FluidSettings settings = periodic_box(0.41);
    settings.initial_velocity = {0.01, -0.02, 0.03};
    settings.body_force = {push, 0, 0};
    FluidCase c = make_fluid_case(settings, true);
    Kokkos::deep_copy(c.flow.drag, drag);
    Relaxation result;
    Real expected = 0.01;
    for (int s = 0; s < 5; ++s) {
        c.step(dt);
        expected = (expected + dt * push / water) / (1 + dt * drag / (water * 0.41));
        Real const error = errors_of(c.flow.grid, c.flow.velocity[0], 0, [&](Vec3) { return expected; }).largest;
        result.error = std::fmax(result.error, error / std::fabs(expected));
    }
    result.end = value_of(host_copy(c.flow.velocity[0]), 0, 0, 0) * drag / (0.41 * push);
    return result;
}

} // namespace

std::vector<VerifyCase> check_relaxation()
{
    std::vector<VerifyCase> rows;
    std::string const source = "closed form: implicit Euler";
    for (Real const drag : {0.0, 1e3, 1e5, 1e7})
        for (Real const dt : {1e-6, 1e-4, 1e-2, 1.0}) {
            Relaxation const found = relax(drag, dt);
            std::string const name = fmt::format("F4 uniform flow, B {:g}, dt {:g} s", drag, dt);
            rows.push_back(compare_error({name, "largest error of u in 5 steps", source}, found.error, 1e-12));
            if (drag >= 1e5 && dt == 1.0)
                rows.push_back(compare({name, "u / steady u", "closed form: n push/B"}, found.end, 1, 1e-9));
        }
    FluidSettings settings = periodic_box(0.5);
    settings.convection = ConvectionScheme::limited;
    FluidCase c = make_fluid_case(settings, true);
    Kokkos::deep_copy(c.flow.drag, 1e6);
    Kokkos::deep_copy(c.flow.drag_velocity[1], 1e6 * 0.02);
    c.steps(10, 1e-2);
    rows.push_back(compare({"F4 grains that move together at 0.02 m/s", "u of the fluid [m/s]", "closed form: theirs"},
                           value_of(host_copy(c.flow.velocity[1]), 1, 1, 1), 0.02, 1e-10));
    return rows;
}

namespace {

/// Superficial velocity U through a bed of drag B: -dp/dz = B U / n^2.
FluidCase make_darcy_column(Real superficial, Real porosity, Real drag)
{
    FluidSettings settings = box_settings({2, 3, 9}, {2e-3, 3e-3, 9e-3});
    add_periodic_axis(settings, 0);
    for (Face const face : {Face::y_lower, Face::y_upper}) settings.patches.push_back(face_patch(face, PatchKind::slip));
    settings.patches.push_back(face_patch(Face::z_lower, PatchKind::velocity, {0, 0, superficial}));
    settings.patches.push_back(face_patch(Face::z_upper, PatchKind::pressure, {}, 101325));
    settings.porosity = porosity;
    settings.initial_pressure = 101325;
    settings.initial_velocity = {0, 0, superficial / porosity};
    settings.pressure_tolerance = 1e-12;
    FluidCase c = make_fluid_case(settings, true);
    Kokkos::deep_copy(c.flow.drag, drag);
    return c;
}

} // namespace

std::vector<VerifyCase> check_darcy()
{
    Real const U = 1e-4, n = 0.41, gradient = 1318.668;
    std::vector<VerifyCase> rows;
    for (Real const dt : {1e-6, 1e-3, 1.0, 1e3}) {
        FluidCase c = make_darcy_column(U, n, gradient * n * n / U);
        FlowReport const report = c.steps(3, dt);
        auto const p = [&](Vec3 x) { return 101325 + gradient * (9e-3 - x.z); };
        std::string const name = fmt::format("F4 Darcy column, 3 steps of {:g} s", dt), source = "closed form: B U/n^2";
        rows.push_back(compare_error({name, "largest error of p / p_out", source},
                                     errors_of(c.flow.grid, c.flow.pressure, -1, p).largest / 101325, 1e-9));
        rows.push_back(compare({name, "outflow [m3/s]", source}, report.outflow, U * 6e-6, 1e-12));
    }
    return rows;
}

std::vector<VerifyCase> check_fluid_at_rest()
{
    FluidSettings settings = box_settings({4, 4, 8}, {4e-3, 4e-3, 8e-3});
    settings.body_force = {0, 0, -water * 9.81};
    settings.convection = ConvectionScheme::limited;
    FluidCase c = make_fluid_case(settings, true);
    set_field(c.flow.grid, c.flow.drag, -1, [](Vec3 x) { return x.z > 4e-3 ? 1e6 : 1e3; });
    set_field(c.flow.grid, c.flow.porosity, -1, [](Vec3 x) { return x.z > 4e-3 ? 0.41 : 0.9; });
    Kokkos::deep_copy(c.flow.porosity_previous, c.flow.porosity);
    c.steps(20, 1e-5);
    Real speed = 0;
    for (int axis = 0; axis < 3; ++axis)
        speed = std::fmax(speed, errors_of(c.flow.grid, c.flow.velocity[axis], axis, [](Vec3) { return 0.0; }).largest);
    HostField const p = host_copy(c.flow.pressure);
    std::string const name = "water at rest, n jumps from 0.9 to 0.41", source = "closed form: hydrostatic";
    return {compare_error({name, "largest speed [m/s]", source}, speed, 1e-12),
            compare({name, "pressure over 7 mm [Pa]", source}, value_of(p, 1, 1, 0) - value_of(p, 1, 1, 7),
                    water * 9.81 * 7e-3, 1e-8)};
}

} // namespace arenite
