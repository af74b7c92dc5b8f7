// SPDX-License-Identifier: MIT
// The balance sheet against closed forms: what it says was lost is what is missing, and nothing is missing that it does
// not say. Its residual is the integrator's error and falls with the square of the step.
#include "apps/run.hpp"
#include "tests/run_tables.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace arenite;
using namespace arenite::test;

std::vector<Row> run_as_it_is(std::string const& scene, std::vector<std::string> overrides)
{
    fs::path const folder = fs::temp_directory_path() / "arenite_balance";
    fs::remove_all(folder);
    RunOptions options;
    options.scene = scene;
    options.folder = folder.string();
    options.quiet = true;
    options.overrides = std::move(overrides);
    EXPECT_EQ(run_scene(options), 0);
    std::vector<Row> const rows = read_table(folder / "history.csv");
    fs::remove_all(folder);
    return rows;
}

std::vector<Row> run(std::string const& scene, std::vector<std::string> overrides)
{
    overrides.emplace_back("output.energies=true");
    return run_as_it_is(scene, std::move(overrides));
}

std::string const scenes = ARENITE_SCENES;

TEST(Balance, CollisionLosesWhatRestitutionTakes)
{
    double residual[3];
    for (int n = 0; n < 3; ++n) {
        double const dt = 8e-9 / (1 << n);
        auto const rows =
            run(scenes + "/collision.toml", {"stages.collision.time_step=" + std::to_string(dt * 1e9) + "e-9"});
        double const start = number(rows.front(), "kinetic_energy"), lost = number(rows.back(), "loss_damping");
        EXPECT_NEAR(lost / start, 1 - 0.8 * 0.8, 1e-3); // of the step; the sheet itself is closer
        EXPECT_NEAR((start - number(rows.back(), "kinetic_energy")) / lost, 1, 2e-5);
        residual[n] = std::fabs(number(rows.back(), "energy_residual")) / start;
    }
    EXPECT_LT(residual[1], 1e-6);
    for (int n = 0; n < 2; ++n) EXPECT_NEAR(std::log2(residual[n] / residual[n + 1]), 2, 0.1);
}

/// U / (pi gamma R* L) of the JKR contact at the root of s, s = a / (pi gamma R*^2 / E*)^(1/3).
double jkr_potential(double s) { return 8. / 15 * std::pow(s, 5) - 8. / 3 * std::pow(s, 3.5) + 2 * s * s; }

TEST(Balance, BondTakesTheWorkOfPeelingFromBToC)
{
    auto const rows = run(scenes + "/pull_test.toml", {});
    Row const* pulled = nullptr;
    for (Row const& row : rows)
        if (row.at("stage") == "pull") pulled = &row;
    ASSERT_NE(pulled, nullptr);
    constexpr double pi = std::numbers::pi, gamma = 30, radius = 0.0575e-3;
    double const modulus = 2e10 / (2 * (1 - 0.09)),
                 length = std::cbrt(pi * pi * gamma * gamma * radius / (modulus * modulus));
    double const unit = pi * gamma * radius * length;
    double const at_B = jkr_potential(std::cbrt(9.)), at_C = jkr_potential(std::cbrt(9. / 4)); // s: 9^(1/3), (9/4)^(1/3)
    EXPECT_NEAR(number(*pulled, "work_held") / ((at_C - at_B) * unit), 1, 1e-3); // the file's overlap is B to 1e-3
    EXPECT_NEAR(number(*pulled, "loss_adhesion") / (at_C * unit), 1, 1e-3);
    EXPECT_LT(std::fabs(number(*pulled, "energy_residual")), 1e-4 * number(*pulled, "work_held"));
    EXPECT_EQ(number(*pulled, "elastic_energy"), 0);
}

TEST(Balance, SettlingGrainGivesItsWeightToTheWater)
{
    auto const rows = run(scenes + "/settling.toml", {"stages.fall.duration=0.04"});
    Row const& end = rows.back();
    double const works = number(end, "work_gravity") + number(end, "work_drag") + number(end, "work_pressure");
    EXPECT_NEAR(number(end, "kinetic_energy") / works, 1, 1e-6);
    EXPECT_NEAR(number(end, "work_pressure") / number(end, "work_gravity"), -998.2 / 2605, 0.01); // buoyancy
    EXPECT_LT(number(end, "work_drag"), 0);
    EXPECT_GT(number(end, "fluid_energy"), 0);
}

// Press, perforate and produce, with servo walls, bonds, friction, local damping, a carrier, water and departing grains.
TEST(Balance, ClosesInAllStages)
{
    int checked = 0;
    for (Row const& row : run(ARENITE_TEST_SCENES "/small.toml", {})) {
        double const through = turnover(row);
        if (!(through > 0)) continue;
        EXPECT_LT(std::fabs(number(row, "energy_residual")), 1e-3 * through) << row.at("stage") << " at " << row.at("time");
        ++checked;
    }
    EXPECT_GT(checked, 50);
}

// A balance looks and does not touch.
TEST(Balance, LeavesTheRunAsItIs)
{
    std::string const small = ARENITE_TEST_SCENES "/small.toml";
    auto const without = run_as_it_is(small, {}), with = run(small, {});
    ASSERT_FALSE(with.empty());
    ASSERT_EQ(without.size(), with.size());
    for (std::size_t n = 0; n < with.size(); ++n)
        for (auto const& [name, cell] : without[n]) EXPECT_EQ(cell, with[n].at(name)) << name << " in row " << n;
}

} // namespace
