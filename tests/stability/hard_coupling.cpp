// SPDX-License-Identifier: MIT
// Hard cases of grains in water (H5-H9, H15, H19, H20): stable, conservative, and told where they are not resolved.
#include "apps/verify/fluid_case.hpp"
#include "tests/stability/hard_scene.hpp"

#include <algorithm>
#include <sstream>

namespace {

using namespace arenite;
using namespace arenite::test;

std::string const soft_sand = "[materials.sand]\ndensity = 2605\nyoungs_modulus = 1e7\npoissons_ratio = 0.3\nrestitution = "
                              "0.8\nfriction = 0.2\n";

std::string periodic_sides()
{
    std::string text;
    for (char const* face : {"x_lower", "x_upper", "y_lower", "y_upper"})
        text += std::string("[[fluid.patches]]\nface = \"") + face + "\"\ntype = \"periodic\"\n";
    return text;
}

std::string column(std::string const& fluid, bool gravity = true)
{
    return std::string("[domain]\nlower = [0, 0, 0]\nupper = [6e-3, 6e-3, 24e-3]\nperiodic = [true, true, false]\n") +
           (gravity ? "gravity = [0, 0, -9.81]\n" : "") + soft_sand + grains_from_file +
           "[[walls]]\nname = \"floor\"\ntype = \"plane\"\nmaterial = \"sand\"\npoint = [0, 0, 0]\nnormal = [0, 0, "
           "1]\n[fluid]\n" +
           fluid + periodic_sides() + "[[fluid.patches]]\nface = \"z_upper\"\ntype = \"pressure\"\npressure = 101325\n";
}

std::string stage(std::string const& duration, std::string const& step)
{
    return "[[stages]]\nname = \"run\"\nduration = " + duration + "\ntime_step = " + step +
           "\nfluid = true\ncontact = { law = \"hertz\" }\n[output]\nenergies = true\n";
}

constexpr double density = 2605, water = 998.2, g = 9.81, d = 0.3e-3;

// H8: the grain's drag time is 1.3e-5 s in a syrup of 1 Pa s. Fluid steps of 1 to 1000 of it end at Stokes' velocity.
// (In a first step no force is known yet but that of a grain at rest: it falls freely through that one, and what it
// stirs calms down in the next few.)
TEST(Stability, FluidStepOfAThousandDragTimes)
{
    double const terminal = (density - water) * g * d * d / (18 * 1.0);
    for (int const interval : {7, 65, 650, 6500}) { // of 2e-6 s
        SCOPED_TRACE(interval);
        HardRun const run = run_hard(
            column("cells = [6, 6, 24]\nviscosity = 1.0\ndrag = \"stokes\"\nsmoothing_length = 3e-3\ncoupling_interval = " +
                   std::to_string(interval) + "\n") +
                stage(interval == 6500 ? "0.13" : "0.0234", "2e-6") +
                "history_interval = 1.3e-3\nprobes = [ { name = \"grain\", grain = 0 } ]\n",
            "x, y, z, diameter\n3e-3, 3e-3, 20e-3, 0.3e-3\n");
        ASSERT_EQ(run.exit_code, 0) << run.messages;
        double fastest = 0; // after four fluid steps
        for (Row const& row : run.history)
            if (number(row, "step") > 4 * interval) fastest = std::fmax(fastest, number(row, "kinetic_energy"));
        double const mass = density * 3.14159265358979 / 6 * d * d * d,
                     speed = std::sqrt(2 * number(run.end(), "kinetic_energy") / mass);
        EXPECT_NEAR(speed / terminal, 1, 0.02) << run.messages; // it drags some syrup along
        EXPECT_NE(run.messages.find("not resolved"), std::string::npos);
        EXPECT_LT(std::sqrt(2 * fastest / mass), 1.1 * terminal); // it does not overshoot
    }
}

/// n^3 grains, 0.33 mm apart, from a corner at x0.
std::string cloud(int n, double x0, double z0, std::string const& velocity)
{
    std::ostringstream csv;
    csv << "x, y, z, diameter, vx, vy, vz\n";
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                csv << x0 + 0.33e-3 * i << ", " << x0 + 0.33e-3 * j << ", " << z0 + 0.33e-3 * k << ", 0.3e-3, " << velocity
                    << "\n";
    return csv.str();
}

/// Largest continuity error of all rows, and everything finite.
void expect_fluid_closes(HardRun const& run)
{
    ASSERT_EQ(run.exit_code, 0) << run.messages;
    for (Row const& row : run.history) {
        for (auto const& [name, cell] : row)
            if (name != "stage" && !cell.empty()) { ASSERT_TRUE(std::isfinite(std::stod(cell))) << name; }
        EXPECT_LT(number(row, "continuity_error"), 1e-8) << "at step " << row.at("step"); // pressure_tolerance
    }
    EXPECT_EQ(run.messages.find("pressure solve stopped"), std::string::npos) << run.messages;
}

// H5: cells that one grain fills to a porosity of 0.19, 0 and -1. They are limited, counted and told, also while the grains
// are driven from cell to cell, and the water's mass closes as it does elsewhere.
TEST(Stability, CellsFullerThanFull)
{
    double const volume = 3.14159265358979 / 6 * d * d * d;
    for (double const porosity : {0.19, 0., -1.}) {
        SCOPED_TRACE(porosity);
        double const h = std::cbrt(volume / (1 - porosity));
        std::ostringstream scene, csv;
        scene.precision(17), csv.precision(17);
        scene << "[domain]\nlower = [0, 0, 0]\nupper = [" << 6 * h << ", " << 6 * h << ", " << 24 * h << "]\n"
              << "periodic = [true, true, false]\n"
              << soft_sand << grains_from_file << "[[groups]]\nname = \"all\"\nids = [0, 1, 2, 3]\nvelocity = [0, 0, -0.5]\n"
              << "[fluid]\ncells = [6, 6, 24]\ncoupling_interval = 20\npressure_tolerance = 1e-13\n"
              << "smoothing_length = " << 1e-3 * h << "\n"
              << periodic_sides() << "[[fluid.patches]]\nface = \"z_upper\"\ntype = \"pressure\"\npressure = 0\n"
              << stage("1e-3", "1e-6") << "history_interval = 1e-4\n"; // 0.5 mm: two or three cells
        csv << "x, y, z, diameter, id\n";
        for (int id = 0; id < 4; ++id)
            csv << (0.5 + 3 * (id % 2)) * h << ", " << (0.5 + 3 * (id / 2)) * h << ", " << 20.5 * h << ", 0.3e-3, " << id
                << "\n";
        HardRun const run = run_hard(scene.str(), csv.str());
        expect_fluid_closes(run);
        for (Row const& row : run.history) EXPECT_LT(number(row, "continuity_error"), 1e-12) << "at step " << row.at("step");
        char hidden[80]; // minimum_porosity is 0.2
        std::snprintf(hidden, sizeof hidden, "%.3g m3 of grains are unseen", 4 * (volume - 0.8 * h * h * h));
        for (std::string const& told :
             {std::string("step 20: 4 cells held more grains than the minimum porosity allows"), std::string(hidden)})
            EXPECT_NE(run.messages.find(told), std::string::npos) << told << "\n" << run.messages;
    }
}

// A flow that leaves all numbers behind ends the run and is named; the steps on the way are warned of.
TEST(Stability, AFlowThatBlowsUpEndsTheRun)
{
    HardRun const run = run_hard(
        "[domain]\nlower = [0, 0, 0]\nupper = [2e-3, 2e-3, 4e-3]\n[fluid]\ncells = [10, 10, 20]\ndensity = 1000\nviscosity "
        "= 1e-6\ntime_step = 3e-4\n[[fluid.patches]]\nface = \"z_lower\"\ntype = \"velocity\"\nvelocity = [0, 0, 2]\n"
        "shape = \"disc\"\ncenter = [1e-3, 1e-3, 0]\ndiameter = 1e-3\n[[fluid.patches]]\nface = \"z_upper\"\ntype = "
        "\"pressure\"\npressure = 0\n[[stages]]\nname = \"flow\"\nduration = 0.3\nfluid = true\n");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.messages.find("Courant number"), std::string::npos) << run.messages;
    EXPECT_NE(run.messages.find("the flow is not finite any more"), std::string::npos) << run.messages;
}

// H6: the porosity jumps from 0.41 to 1 at the wall of a shaft of the hole's width, 2.6 mm, that ends in the hole: 2.4 cells
// of 1.5 mm, or 4.7 of half of that. Darcy's pressure and a creeping flow's have no extremes inside; neither has ours.
TEST(Stability, PorosityJumpAtTheHole)
{
    constexpr Real hole = 2.6e-3, box[3] = {18e-3, 18e-3, 9e-3}, inflow = 1e-4; // m, m/s
    for (int const refinement : {1, 2}) {
        SCOPED_TRACE(refinement);
        FluidSettings settings = box_settings({12 * refinement, 12 * refinement, 6 * refinement}, {box[0], box[1], box[2]});
        settings.convection = ConvectionScheme::limited;
        add_periodic_axis(settings, 0);
        settings.patches.push_back(face_patch(Face::y_lower, PatchKind::velocity, {0, inflow, 0}));
        settings.patches.push_back(face_patch(Face::y_upper, PatchKind::velocity, {0, -inflow, 0}));
        settings.patches.push_back(face_patch(Face::z_upper, PatchKind::pressure));
        settings.patches.back().shape = PatchShape::disc;
        settings.patches.back().center = {box[0] / 2, box[1] / 2, 0};
        settings.patches.back().diameter = hole;
        FluidCase c = make_fluid_case(settings, true);
        auto const in_shaft = [&](Vec3 const& x) { return std::hypot(x.x - box[0] / 2, x.y - box[1] / 2) < hole / 2; };
        Real const drag = 1250.6 * 0.41 * 0.41 / inflow; // kg/(m3 s), of the paper's sand
        set_field(c.flow.grid, c.flow.porosity, -1, [&](Vec3 const& x) { return in_shaft(x) ? 1 : 0.41; });
        set_field(c.flow.grid, c.flow.drag, -1, [&](Vec3 const& x) { return in_shaft(x) ? 0 : drag; });
        Kokkos::deep_copy(c.flow.porosity_previous, c.flow.porosity);
        FlowReport const report = c.steps(30, 1e-2);
        EXPECT_TRUE(report.converged());
        EXPECT_NEAR(report.outflow / (2 * inflow * box[0] * box[2]), 1, 1e-12);
        HostField const p = host_copy(c.flow.pressure);
        auto const& n = c.flow.grid.cells;
        Real low = value_of(p, 0, 0, 0), high = low, wiggle = 0;
        for (int k = 0; k < n[2]; ++k)
            for (int j = 0; j < n[1]; ++j)
                for (int i = 0; i < n[0]; ++i) {
                    Real const here = value_of(p, i, j, k);
                    low = std::fmin(low, here), high = std::fmax(high, here);
                    // Extremes belong at the inlet and at the hole.
                    bool const at_inlet = j == 0 || j == n[1] - 1;
                    if (at_inlet || (k == n[2] - 1 && in_shaft(c.flow.grid.center(i, j, k)))) continue;
                    std::vector<Real> around;
                    for (int axis = 0; axis < 3; ++axis)
                        for (int side : {-1, 1}) {
                            int at[3] = {i, j, k};
                            at[axis] += side;
                            if (axis == 0) at[0] = (at[0] + n[0]) % n[0];
                            if (at[axis] >= 0 && at[axis] < n[axis]) around.push_back(value_of(p, at[0], at[1], at[2]));
                        }
                    auto const [least, most] = std::minmax_element(around.begin(), around.end());
                    wiggle = std::fmax(wiggle, std::fmax(here - *most, *least - here));
                }
        EXPECT_GT(high - low, 1); // Pa: there is a flow to wiggle
        EXPECT_LT(wiggle, 0.05 * (high - low));
    }
}

// H19, H7: grains that cross a cell and more in a fluid step, so that cells fill and empty within one.
TEST(Stability, GrainsFasterThanACellPerFluidStep)
{
    HardRun const run = run_hard(column("cells = [6, 6, 24]\ncoupling_interval = 100\nsmoothing_length = 1.5e-3\n", false) +
                                     stage("2e-3", "1e-6") + "history_interval = 1e-4\n",
                                 cloud(5, 2e-3, 20e-3, "0, 0, -15")); // 1.5 cells in 1e-4 s
    expect_fluid_closes(run);
    // Drag and pressure are all that acts: they took what the grains lost.
    double const works = number(run.end(), "work_drag") + number(run.end(), "work_pressure");
    double const lost = number(run.history.front(), "kinetic_energy") - number(run.end(), "kinetic_energy");
    EXPECT_GT(lost, 0);
    EXPECT_NEAR(-works,
                lost - number(run.end(), "loss_damping") - number(run.end(), "loss_tangential") -
                    number(run.end(), "elastic_energy"),
                0.01 * lost);
}

// H9: cells of a quarter to one diameter under a kernel of three diameters: the grain settles as in coarse cells.
TEST(Stability, CellsFinerThanAGrain)
{
    double reference = 0;
    for (int const cells : {4, 8, 16}) { // along 1.2 mm: 1, 0.5 and 0.25 diameters
        SCOPED_TRACE(cells);
        std::string const n = std::to_string(cells);
        std::string const scene = "[domain]\nlower = [0, 0, 0]\nupper = [1.2e-3, 1.2e-3, 2.4e-3]\nperiodic = [true, true, "
                                  "false]\ngravity = [0, 0, -9.81]\n" +
                                  soft_sand + grains_from_file + "[fluid]\ncells = [" + n + ", " + n + ", " +
                                  std::to_string(2 * cells) + "]\ncoupling_interval = 10\nsmoothing_length = 0.9e-3\n" +
                                  periodic_sides() +
                                  "[[fluid.patches]]\nface = \"z_upper\"\ntype = \"pressure\"\npressure = 0\n" +
                                  stage("0.004", "5e-6") + "history_interval = 1e-3\n";
        HardRun const run = run_hard(scene, "x, y, z, diameter\n0.6e-3, 0.6e-3, 1.8e-3, 0.3e-3\n");
        expect_fluid_closes(run);
        double const energy = number(run.end(), "kinetic_energy");
        if (cells == 4) reference = energy;
        else EXPECT_NEAR(std::sqrt(energy / reference), 1, 0.03);
        EXPECT_EQ(run.messages.find("porosity"), std::string::npos) << run.messages; // no cell was limited
    }
}

// H15: a fluid of one cell; a grain in it.
TEST(Stability, OneCell)
{
    std::string const scene = "[domain]\nlower = [0, 0, 0]\nupper = [2e-3, 2e-3, 2e-3]\ngravity = [0, 0, -9.81]\n" +
                              soft_sand + grains_from_file + "[fluid]\ncells = [1, 1, 1]\ncoupling_interval = 10\n" +
                              stage("1e-3", "5e-6");
    expect_fluid_closes(run_hard(scene, "x, y, z, diameter\n1e-3, 1e-3, 1e-3, 0.3e-3\n"));
}

// H20: a bed at rest under still water stays at rest, and so does the water.
TEST(Stability, StillWaterOverAStillBed)
{
    std::string const fluid = "cells = [6, 6, 24]\ncoupling_interval = 20\nsmoothing_length = 1.5e-3\n";
    // One layer on the floor: each grain's overlap carries its weight in water.
    double const weight = (density - water) * 3.14159265358979 / 6 * d * d * d * g, modulus = 1e7 / (1 - 0.09) / 2;
    double const overlap = std::pow(weight / (4. / 3 * modulus * std::sqrt(d / 2)), 2. / 3);
    std::ostringstream csv;
    csv.precision(17);
    csv << "x, y, z, diameter\n";
    for (int j = 0; j < 15; ++j)
        for (int i = 0; i < 15; ++i)
            csv << 0.2e-3 + 0.4e-3 * i << ", " << 0.2e-3 + 0.4e-3 * j << ", " << d / 2 - overlap << ", 0.3e-3\n";
    HardRun const run = run_hard(column(fluid) + stage("0.2", "5e-6") + "history_interval = 0.01\n",
                                 csv.str()); // 40 000 steps
    expect_fluid_closes(run);
    double const volume = number(run.end(), "fluid_volume"), mass = density * 3.14159265358979 / 6 * d * d * d;
    EXPECT_LT(std::sqrt(2 * number(run.end(), "fluid_energy") / (water * volume)), 1e-9); // m/s, root mean square
    EXPECT_LT(std::sqrt(2 * number(run.end(), "kinetic_energy") / (225 * mass)), 1e-8);
    EXPECT_EQ(number(run.end(), "contacts"), number(run.history[1], "contacts"));
}

} // namespace
