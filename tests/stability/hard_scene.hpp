// SPDX-License-Identifier: MIT
// Runs a scene that a test wrote, with a balance, and gives what it left behind.
#pragma once

#include "apps/run.hpp"
#include "io/checkpoint_folder.hpp"
#include "tests/run_tables.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace arenite::test {

struct HardRun {
    fs::path folder;
    int exit_code = -1;
    std::string messages; // on the error stream
    std::vector<Row> history, produced;

    Row const& end() const { return history.back(); }
    HardRun() = default;
    HardRun(HardRun&& other) noexcept { std::swap(*this, other); }
    HardRun& operator=(HardRun&& other) noexcept
    {
        std::swap(folder, other.folder);
        std::swap(exit_code, other.exit_code);
        std::swap(messages, other.messages);
        std::swap(history, other.history);
        std::swap(produced, other.produced);
        return *this;
    }
    ~HardRun()
    {
        if (!folder.empty()) fs::remove_all(folder);
    }
};

/// scene: TOML text. grains: the text of grains.csv beside it, or empty.
inline HardRun run_hard(std::string const& scene, std::string const& grains = {}, std::vector<std::string> overrides = {})
{
    static int number_of_run = 0;
    HardRun run;
    run.folder =
        fs::temp_directory_path() / ("arenite_hard_" + std::to_string(::getpid()) + "_" + std::to_string(++number_of_run));
    fs::remove_all(run.folder);
    fs::create_directories(run.folder);
    std::ofstream(run.folder / "scene.toml") << scene;
    if (!grains.empty()) std::ofstream(run.folder / "grains.csv") << grains;
    RunOptions options;
    options.scene = (run.folder / "scene.toml").string();
    options.folder = (run.folder / "out").string();
    options.overrides = std::move(overrides);
    options.quiet = true;
    testing::internal::CaptureStderr();
    try {
        run.exit_code = run_scene(options);
    } catch (std::exception const& error) {
        run.messages = error.what();
        run.exit_code = 2;
    }
    run.messages += testing::internal::GetCapturedStderr();
    run.history = read_table(run.folder / "out" / "history.csv");
    run.produced = read_table(run.folder / "out" / "produced.csv");
    return run;
}

/// The turnover of the sheet and the energies themselves, by size, J.
inline double energies_and_turnover(Row const& row)
{
    double sum = turnover(row);
    for (auto const& [name, cell] : row)
        if (name.size() > 7 && name.substr(name.size() - 7) == "_energy") sum += std::fabs(number(row, name));
    return sum;
}

/// No NaN or infinity anywhere, no grain lost but produced ones, energies balanced to a share of their turnover.
inline void expect_sound(HardRun const& run, double balance)
{
    ASSERT_EQ(run.exit_code, 0) << run.messages;
    ASSERT_FALSE(run.history.empty());
    EXPECT_EQ(run.messages.find("lost_grains"), std::string::npos) << run.messages;
    double const grains = number(run.history.front(), "grains");
    double largest = 0;
    for (Row const& row : run.history) {
        for (auto const& [name, cell] : row)
            if (name != "stage" && !cell.empty()) {
                EXPECT_TRUE(std::isfinite(std::stod(cell))) << name << " at step " << row.at("step");
            }
        EXPECT_EQ(number(row, "grains") + number(row, "produced_count"), grains) << "at step " << row.at("step");
        largest = std::fmax(largest, energies_and_turnover(row));
        EXPECT_LE(std::fabs(number(row, "energy_residual")), balance * largest) << "at step " << row.at("step");
    }
}

inline std::string box_of(double edge, bool periodic)
{
    std::string const e = std::to_string(edge), p = periodic ? "true" : "false";
    return "[domain]\nlower = [0, 0, 0]\nupper = [" + e + ", " + e + ", " + e + "]\nperiodic = [" + p + ", " + p + ", " + p +
           "]\n";
}

inline std::string sand_of(std::string const& values)
{
    return "[materials.sand]\ndensity = 2605\nyoungs_modulus = 2e10\npoissons_ratio = 0.3\n" + values + "\n";
}

inline std::string const grains_from_file = "[particles]\nsource = \"file\"\nfile = \"grains.csv\"\nmaterial = \"sand\"\n";

} // namespace arenite::test
