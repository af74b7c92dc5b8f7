// SPDX-License-Identifier: MIT
// One sphere in a fluid that it moves through: terminal velocity and the way there, by the drag laws' own closed
// forms, whatever the cell's size.
#include "apps/verify/coarse_checks.hpp"
#include "apps/verify/coupled_case.hpp"
#include "apps/verify/coupling_checks.hpp"

#include <fmt/format.h>

namespace arenite {
namespace {

struct FallSettings {
    Real diameter = 0.23e-3, cell = 1.5e-3; // m
    DragLaw law = DragLaw::di_felice;
    Real terminal = 0; // m/s, closed form at n = 1
    Real factor = 1;   // k: the grain is k diameters wide
    std::array<int, 3> cells{6, 6, 10};
    Real grain_density = 2605, density = 998.2, viscosity = 1e-3;
    Real smoothing_length = 0;
    Real response = 0.00409423; // s, about the time to 63 % of the terminal velocity
    Real times = 6;             // of it until the end
    int steps = 100;            // fluid steps in it
    Real start = 0;             // m/s, downwards
};

struct Fall {
    Real speed = 0, slip = 0, expected_slip = 0; // m/s at the end
    Real time_63 = 0, time_95 = 0;               // s, to these shares of the terminal velocity
    bool converged = false;
};

/// Still fluid in a closed box; the grain starts at rest below the top.
Fall settle(FallSettings const& s)
{
    CoupledSettings settings;
    FluidSettings& fluid = settings.fluid;
    fluid.cells = s.cells;
    Vec3 const size{s.cells[0] * s.cell, s.cells[1] * s.cell, s.cells[2] * s.cell};
    fluid.box = Region{{0, 0, 0}, size};
    fluid.drag = s.law;
    fluid.density = s.density;
    fluid.viscosity = s.viscosity;
    fluid.smoothing_length = s.smoothing_length;
    settings.coarse_grain_factor = s.factor;
    SystemSettings& system = settings.grains;
    // Off the middle by a tenth of a cell of the coarsest kind, a share of the box in any grid.
    system.grains = {
        make_grain(0, {0.517 * size.x, 0.483 * size.y, 0.82 * size.z}, s.factor * s.diameter, {0, 0, -s.start})};
    system.materials = {make_material(s.grain_density, 1e6, 0.3)};
    system.skin = s.diameter;
    constexpr int grain_steps = 5;
    Real const dt = s.response / s.steps;
    system.dt = dt / grain_steps;
    CoupledCase run = make_coupled_case(settings);
    Fall fall;
    Real before = 0;
    for (int n = 0; n < static_cast<int>(s.times * s.steps); ++n) {
        run.step(dt);
        Real const after = -grains_by_id(run.grains)[0].velocity.z;
        for (auto const& [mark, time] :
             {std::pair{(1 - std::exp(-1.)) * s.terminal, &fall.time_63}, std::pair{0.95 * s.terminal, &fall.time_95}})
            if (*time == 0 && after >= mark) *time = (n + (mark - before) / (after - before)) * dt;
        before = after;
    }
    deposit_porosity(run.fluid.flow, run.exchange, run.grains.particles);
    deposit_drag(run.fluid.flow, run.exchange, run.grains.particles, dt);
    std::array<Real, 4> const at_grain = fluid_at_grain(run.exchange);
    fall.speed = before;
    fall.slip = at_grain[2] + fall.speed;
    fall.expected_slip = terminal_slip(fluid, s.diameter, s.grain_density, at_grain[3]);
    fall.converged = run.converged;
    return fall;
}

FallSettings fall_of(Real diameter, Real terminal, DragLaw law = DragLaw::di_felice)
{
    FallSettings settings;
    settings.diameter = diameter;
    settings.terminal = terminal;
    settings.law = law;
    return settings;
}

} // namespace

std::vector<VerifyCase> check_single_grain()
{
    struct Case {
        Real diameter, terminal, time_63, time_95;
    };
    std::vector<VerifyCase> rows;
    for (Case const& c :
         {Case{0.15e-3, 0.014423638, 0.00223001, 0.00640088}, Case{0.23e-3, 0.027330186, 0.00409423, 0.0115176},
          Case{0.355e-3, 0.048289111, 0.0069827, 0.0192032}, Case{0.46e-3, 0.065331051, 0.00925209, 0.0251034}})
        for (Real const cell : {1.5e-3, 3 * c.diameter}) {
            if (cell != 1.5e-3 && c.diameter != 0.23e-3) continue;
            FallSettings settings = fall_of(c.diameter, c.terminal);
            settings.response = c.time_63;
            settings.cell = cell;
            if (cell < 1.4e-3) settings.cells = {7, 7, 12}; // 21 diameters wide
            Fall const fall = settle(settings);
            std::string const name = fmt::format("C1 {} mm sphere in water, cell {:g} mm", c.diameter * 1e3, cell * 1e3),
                              source = "Di Felice 1994 with Dallavalle 1948";
            rows.push_back(compare({name, "slip at the end [m/s], at the n that the law sees", source}, fall.slip,
                                   fall.expected_slip, 5e-3));
            if (cell != 1.5e-3) continue;
            rows.push_back(compare({name, "time to 63.2 % of v_t [s]", source}, fall.time_63, c.time_63, 1e-2));
            rows.push_back(compare({name, "time to 95 % of v_t [s]", source}, fall.time_95, c.time_95, 2e-2));
        }
    Fall const schiller = settle(fall_of(0.23e-3, 0.029683397, DragLaw::schiller_naumann));
    rows.push_back(compare({"C1 0.23 mm sphere in water, cell 1.5 mm", "slip at the end [m/s]", "Schiller & Naumann 1935"},
                           schiller.slip, 0.029683397, 5e-3));
    return rows;
}

namespace {

/// CFDEM's settlingTestMPI: d 0.1 mm, rho 3000 in 10, nu 1e-5.
Real light_fluid_speed(DragLaw law, Real terminal)
{
    FallSettings settings = fall_of(0.1e-3, terminal, law);
    settings.grain_density = 3000;
    settings.density = 10;
    settings.viscosity = 1e-4;
    settings.cell = 2e-3;
    settings.cells = {5, 5, 12};
    settings.response = 0.015;
    settings.steps = 40;
    return settle(settings).slip;
}

} // namespace

std::vector<VerifyCase> check_light_fluid()
{
    struct Case {
        std::string source;
        DragLaw law;
        Real terminal;
    };
    std::vector<VerifyCase> rows;
    for (Case const& c : {Case{"Di Felice 1994, n 1", DragLaw::di_felice, 0.1286095314},
                          Case{"Schiller & Naumann 1935", DragLaw::schiller_naumann, 0.1373372851},
                          Case{"Stokes 1851", DragLaw::stokes, 0.162955}})
        rows.push_back(compare({"C1b 0.1 mm sphere, rho 3000 in 10", "slip at the end [m/s]", c.source},
                               light_fluid_speed(c.law, c.terminal), c.terminal, 5e-3));
    return rows;
}

std::vector<VerifyCase> check_rising_gas()
{
    // A sphere of 0.1 mm and 2000 kg/m3 in gas that rises at 0.4 m/s.
    CoupledSettings settings;
    FluidSettings& fluid = settings.fluid;
    fluid = box_settings({3, 3, 6}, {24e-3, 24e-3, 48e-3}); // wide: what it drags along is small
    for (int axis = 0; axis < 2; ++axis) add_periodic_axis(fluid, axis);
    fluid.patches.push_back(face_patch(Face::z_lower, PatchKind::velocity, {0, 0, 0.4}));
    fluid.patches.push_back(face_patch(Face::z_upper, PatchKind::pressure));
    fluid.gravity = true;
    fluid.initial_velocity = {0, 0, 0.4};
    fluid.density = 1.2;
    fluid.viscosity = 1.8e-5;
    fluid.drag = DragLaw::schiller_naumann;
    SystemSettings& system = settings.grains;
    system.grains = {make_grain(0, {12.4e-3, 11.6e-3, 44e-3}, 1e-4)};
    system.materials = {make_material(2000, 1e6, 0.3)};
    system.skin = 1e-4;
    system.dt = 1e-5;
    constexpr Real dt = 5e-5;
    CoupledCase run = make_coupled_case(settings);
    std::vector<VerifyCase> rows;
    Real const marks[][2] = {{0.01, -0.012582322}, {0.02, -0.022439568}, {0.05, -0.040885066},
                             {0.1, -0.05275472},   {0.2, -0.057143396},  {0.35, -0.057526311}};
    int done = 0;
    for (auto const& [time, speed] : marks) {
        for (; done < std::lround(time / dt); ++done) run.step(dt);
        rows.push_back(compare({"MFIX DEM06, 0.1 mm sphere in rising gas", fmt::format("velocity at {} s [m/s]", time),
                                "MFIX DEM06: Schiller & Naumann, integrated"},
                               grains_by_id(run.grains)[0].velocity.z, speed, 6e-3));
    }
    return rows;
}

std::vector<VerifyCase> check_cell_sizes()
{
    // The kernel is at least 1.5 cells and 3 diameters in radius, the box 9 to 40 diameters wide.
    struct Case {
        Real ratio; // diameter over cell
        int across, high;
        Real smoothing; // diameters; 0: the default of 1.5 cells
    };
    Real const diameter = 0.23e-3, terminal = 0.027330186;
    std::vector<VerifyCase> rows;
    Real previous = 1e9, rise = 0;
    for (Case const& c : {Case{0.1, 4, 6, 0}, Case{0.5, 8, 12, 0}, Case{1, 12, 18, 3}, Case{2, 18, 24, 3}}) {
        FallSettings settings = fall_of(diameter, terminal);
        settings.cell = diameter / c.ratio;
        settings.cells = {c.across, c.across, c.high};
        settings.smoothing_length = c.smoothing * diameter;
        settings.start = terminal;
        settings.times = 2; // the fluid's own motion round it sets in
        settings.steps = 30;
        Fall const fall = settle(settings);
        std::string const name = fmt::format("C2 0.23 mm sphere in water, d/x {}", c.ratio);
        if (c.ratio <= 1) rows.push_back(compare({name, "speed [m/s]", "Di Felice 1994, n 1"}, fall.speed, terminal, 3e-2));
        rows.push_back(
            compare({name, "slip [m/s] at the n that the law sees", "Di Felice 1994"}, fall.slip, fall.expected_slip, 1e-2));
        rise = std::fmax(rise, fall.slip - previous);
        previous = fall.slip;
    }
    rows.push_back(compare_error({"C2 0.23 mm sphere in water, d/x 0.1 to 2", "rise of the slip with d/x [m/s]",
                                  "the kernel's n falls, so does the slip"},
                                 rise, 1e-4));
    return rows;
}

std::vector<VerifyCase> check_coarse_settling()
{
    Real const terminal = 0.027330186;
    std::vector<VerifyCase> rows;
    Fall const one = settle(fall_of(0.23e-3, terminal));
    for (Real const k : {2.0, 4.0}) {
        FallSettings settings = fall_of(0.23e-3, terminal);
        settings.factor = k;
        settings.cell *= k; // the same picture k times as large: the same n
        Fall const coarse = settle(settings);
        std::string const name = fmt::format("G7 grain of k = {} in cells k times as large", k),
                          source = "the same at k = 1";
        rows.push_back(compare({name, "slip at the end [m/s]", source}, coarse.slip, one.slip, 1e-3));
        rows.push_back(compare({name, "time to 63.2 % of v_t [s]", source}, coarse.time_63, one.time_63, 1e-3));
    }
    FallSettings settings = fall_of(0.23e-3, terminal);
    settings.factor = 2; // in the same cells: n is lower
    Fall const coarse = settle(settings);
    rows.push_back(
        compare({"G7 grain of k = 2 in the same cells", "slip [m/s] at the n that the law sees", "Di Felice 1994"},
                coarse.slip, coarse.expected_slip, 5e-3));
    return rows;
}

} // namespace arenite
