// SPDX-License-Identifier: MIT
// Hard cases of grains in water (H7-H9, H15, H19, H20): stable, conservative, and told where they are not resolved.
#include "tests/stability/hard_scene.hpp"

#include <sstream>

namespace {

using namespace arenite;
using namespace arenite::test;

std::string const soft_sand = "[materials.sand]\ndensity = 2605\nyoungs_modulus = 1e7\npoissons_ratio = 0.3\nrestitution = 0.8\nfriction = 0.2\n";

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
           "[[walls]]\nname = \"floor\"\ntype = \"plane\"\nmaterial = \"sand\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n[fluid]\n" + fluid +
           periodic_sides() + "[[fluid.patches]]\nface = \"z_upper\"\ntype = \"pressure\"\npressure = 101325\n";
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
            column("cells = [6, 6, 24]\nviscosity = 1.0\ndrag = \"stokes\"\nsmoothing_length = 3e-3\ncoupling_interval = " + std::to_string(interval) + "\n") +
                stage(interval == 6500 ? "0.13" : "0.0234", "2e-6") + "history_interval = 1.3e-3\nprobes = [ { name = \"grain\", grain = 0 } ]\n",
            "x, y, z, diameter\n3e-3, 3e-3, 20e-3, 0.3e-3\n");
        ASSERT_EQ(run.exit_code, 0) << run.messages;
        double fastest = 0; // after four fluid steps
        for (Row const& row : run.history)
            if (number(row, "step") > 4 * interval) fastest = std::fmax(fastest, number(row, "kinetic_energy"));
        double const mass = density * 3.14159265358979 / 6 * d * d * d, speed = std::sqrt(2 * number(run.end(), "kinetic_energy") / mass);
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
                csv << x0 + 0.33e-3 * i << ", " << x0 + 0.33e-3 * j << ", " << z0 + 0.33e-3 * k << ", 0.3e-3, " << velocity << "\n";
    return csv.str();
}

/// Largest continuity error of all rows, and everything finite.
void expect_fluid_closes(HardRun const& run)
{
    ASSERT_EQ(run.exit_code, 0) << run.messages;
    for (Row const& row : run.history) {
        for (auto const& [name, cell] : row)
            if (name != "stage" && !cell.empty()) ASSERT_TRUE(std::isfinite(std::stod(cell))) << name;
        EXPECT_LT(number(row, "continuity_error"), 1e-8) << "at step " << row.at("step"); // pressure_tolerance
    }
    EXPECT_EQ(run.messages.find("pressure solve stopped"), std::string::npos) << run.messages;
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
    EXPECT_NEAR(-works, lost - number(run.end(), "loss_damping") - number(run.end(), "loss_tangential") - number(run.end(), "elastic_energy"),
                0.01 * lost);
}

// H9: cells of a quarter to one diameter under a kernel of three diameters: the grain settles as in coarse cells.
TEST(Stability, CellsFinerThanAGrain)
{
    double reference = 0;
    for (int const cells : {4, 8, 16}) { // along 1.2 mm: 1, 0.5 and 0.25 diameters
        SCOPED_TRACE(cells);
        std::string const n = std::to_string(cells);
        std::string const scene =
            "[domain]\nlower = [0, 0, 0]\nupper = [1.2e-3, 1.2e-3, 2.4e-3]\nperiodic = [true, true, false]\ngravity = [0, 0, -9.81]\n" + soft_sand +
            grains_from_file + "[fluid]\ncells = [" + n + ", " + n + ", " + std::to_string(2 * cells) +
            "]\ncoupling_interval = 10\nsmoothing_length = 0.9e-3\n" + periodic_sides() +
            "[[fluid.patches]]\nface = \"z_upper\"\ntype = \"pressure\"\npressure = 0\n" + stage("0.004", "5e-6") + "history_interval = 1e-3\n";
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
    std::string const scene = "[domain]\nlower = [0, 0, 0]\nupper = [2e-3, 2e-3, 2e-3]\ngravity = [0, 0, -9.81]\n" + soft_sand + grains_from_file +
                              "[fluid]\ncells = [1, 1, 1]\ncoupling_interval = 10\n" + stage("1e-3", "5e-6");
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
        for (int i = 0; i < 15; ++i) csv << 0.2e-3 + 0.4e-3 * i << ", " << 0.2e-3 + 0.4e-3 * j << ", " << d / 2 - overlap << ", 0.3e-3\n";
    HardRun const run = run_hard(column(fluid) + stage("0.2", "5e-6") + "history_interval = 0.01\n", csv.str()); // 40 000 steps
    expect_fluid_closes(run);
    double const volume = number(run.end(), "fluid_volume"), mass = density * 3.14159265358979 / 6 * d * d * d;
    EXPECT_LT(std::sqrt(2 * number(run.end(), "fluid_energy") / (water * volume)), 1e-9); // m/s, root mean square
    EXPECT_LT(std::sqrt(2 * number(run.end(), "kinetic_energy") / (225 * mass)), 1e-8);
    EXPECT_EQ(number(run.end(), "contacts"), number(run.history[1], "contacts"));
}

} // namespace
