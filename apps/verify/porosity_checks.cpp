// SPDX-License-Identifier: MIT
// Porosity that jumps in space or moves in time, and holes with cut faces.
#include "apps/verify/fluid_case.hpp"
#include "apps/verify/fluid_checks.hpp"

#include <fmt/format.h>

#include <numbers>

namespace arenite {
namespace {

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

struct Layer {
    Real porosity, gradient; // -, Pa/m at U
};

Real drag_of(Layer const& bed) { return bed.gradient * bed.porosity * bed.porosity / U; }

struct JumpErrors {
    Real flux = 0;      // largest |n u - U| / U
    Real overshoot = 0; // of the pressure gradient beyond the two beds', over the larger
    Real continuity = 0;
};

/// Steady flow through `below` and, from half the height on, `above`; thick: cells of `above`, 0 to the top.
JumpErrors flow_through_jump(Layer below, Layer above, int thick)
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
    JumpErrors errors;
    errors.continuity = c.steps(30, 1e-2).continuity_error;
    HostField const u = host_copy(c.flow.velocity[2]), p = host_copy(c.flow.pressure), n = host_copy(c.flow.porosity);
    Real const low = std::fmin(below.gradient, above.gradient), high = std::fmax(below.gradient, above.gradient);
    for (int k = 1; k < cells; ++k) {
        Real const face_porosity = (value_of(n, 0, 0, k) + value_of(n, 0, 0, k - 1)) / 2;
        errors.flux = std::fmax(errors.flux, std::fabs(face_porosity * value_of(u, 0, 0, k) / U - 1));
        Real const gradient = (value_of(p, 0, 0, k - 1) - value_of(p, 0, 0, k)) / c.flow.grid.spacing.z;
        errors.overshoot = std::fmax(errors.overshoot, std::fmax(low - gradient, gradient - high) / high);
    }
    return errors;
}

} // namespace

std::vector<VerifyCase> check_porosity_jumps()
{
    struct Case {
        std::string name;
        Layer below, above;
        int thick;
    };
    Layer const clear{1, 0}, dense{0.41, 1318.6683}, loose{0.60, 149.58775};
    std::vector<VerifyCase> rows;
    for (Case const& c :
         {Case{"1 | 0.41", clear, dense, 0}, Case{"0.41 | 1", dense, clear, 0}, Case{"0.41 | 0.60", dense, loose, 0},
          Case{"one cell of 1 in 0.41", dense, clear, 1}, Case{"one cell of 0.41 in 1", clear, dense, 1}}) {
        JumpErrors const found = flow_through_jump(c.below, c.above, c.thick);
        std::string const name = "F6 porosity " + c.name, source = "closed form: n u = U, Di Felice on either side";
        rows.push_back(compare_error({name, "largest |n u - U| / U", source}, found.flux, 1e-10));
        rows.push_back(compare_error({name, "overshoot of grad p", source}, found.overshoot, 1e-3));
        rows.push_back(compare_error({name, "dt (dn/dt + div(n u))", "continuity"}, found.continuity, 1e-12));
    }
    return rows;
}

std::vector<VerifyCase> check_moving_porosity()
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
    Real worst = 0;
    bool converged = true;
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
        worst = std::fmax(worst, std::fabs(gain - report.inflow + report.outflow) / throughput);
        converged = converged && report.converged();
    }
    std::string const name = "F7 porosity waves, open top, 20 steps";
    return {compare_error({name, "|sum dn/dt V + net outflow| / throughput", "closed form: 0 in every step"}, worst, 1e-12),
            expect_true({name, "every solve converged", "solver"}, converged)};
}

namespace {

constexpr Real hole = 2.6e-3, hole_area = std::numbers::pi_v<Real> * hole * hole / 4; // m, m2

/// The paper's box: inflow through both y faces, holes of 2.6 mm at the top and at the bottom.
FluidCase make_perforated_box(int refinement)
{
    FluidSettings settings = box_settings({12 * refinement, 12 * refinement, 6 * refinement}, {18e-3, 18e-3, 9e-3});
    add_periodic_axis(settings, 0);
    settings.porosity = 0.41;
    settings.initial_pressure = 101325;
    settings.patches.push_back(face_patch(Face::y_lower, PatchKind::velocity, {0, U, 0}));
    settings.patches.push_back(face_patch(Face::y_upper, PatchKind::velocity, {0, -U, 0}));
    for (Face const face : {Face::z_lower, Face::z_upper}) {
        PatchSettings patch = face_patch(face, PatchKind::pressure, {}, 101325);
        patch.shape = PatchShape::disc;
        patch.center = {9e-3, 9e-3, 0};
        patch.diameter = hole;
        settings.patches.push_back(patch);
    }
    FluidCase c = make_fluid_case(settings, true);
    Kokkos::deep_copy(c.flow.drag, 1250.6 * 0.41 * 0.41 / U);
    return c;
}

/// Pressure over that of the holes, mean over the cells at the inlet face, Pa.
Real inlet_pressure(FluidCase const& c)
{
    HostField const p = host_copy(c.flow.pressure);
    Real sum = 0;
    int const nx = c.flow.grid.cells[0], nz = c.flow.grid.cells[2];
    for (int k = 0; k < nz; ++k)
        for (int i = 0; i < nx; ++i) sum += value_of(p, i, 0, k) - 101325;
    return sum / (nx * nz);
}

} // namespace

std::vector<VerifyCase> check_holes()
{
    std::vector<VerifyCase> rows;
    Real const inflow = 2 * U * 18e-3 * 9e-3;
    for (Real const dt : {1e-6, 1e-2}) {
        FluidCase c = make_perforated_box(1);
        Real worst = 0;
        for (int s = 0; s < 10; ++s) {
            FlowReport const report = c.step(dt);
            worst = std::fmax(worst, std::fabs(report.inflow / inflow - 1));
            worst = std::fmax(worst, std::fabs(report.outflow / inflow - 1));
        }
        HostField const w = host_copy(c.flow.velocity[2]);
        Real top = 0;
        for (int j = 0; j < 12; ++j)
            for (int i = 0; i < 12; ++i) top += 0.41 * value_of(w, i, j, 6) * c.flow.grid.face_area(2);
        std::string const name = fmt::format("F8 two holes of 2.6 mm, dt {:g} s", dt);
        rows.push_back(compare_error({name, "|flow / inflow - 1|, 10 steps", "closed form: 3.24e-8 m3/s"}, worst, 1e-12));
        rows.push_back(compare({name, "mean speed in the hole [m/s]", "closed form: half the inflow each"}, top / hole_area,
                               3.0513e-3, 1e-4));
    }
    // Darcy flow to a disc of constant pressure: the pressure is regular at the inlet, singular at the rim.
    Real pressure[3];
    for (int level = 0; level < 3; ++level) {
        FluidCase c = make_perforated_box(1 << level);
        c.steps(6, 1e-2);
        pressure[level] = inlet_pressure(c);
    }
    rows.push_back(at_most({"F8 two holes, 12, 24, 48 cells", "|p - p finer| / p finer, 24 to 48", "grid refinement"},
                           std::fabs(pressure[1] / pressure[2] - 1), std::fabs(pressure[0] / pressure[1] - 1)));
    return rows;
}

} // namespace arenite
