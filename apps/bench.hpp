// SPDX-License-Identifier: MIT
// `arenite bench`: particle-steps/s of a pack under a law, one JSON line per result.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace arenite {

struct BenchOptions {
    std::string pack;             // text file of "x y z radius" lines, m; "": a random pack that is made
    std::string law = "hertz";    // hertz or jkr
    int grains = 33752;           // of the random pack
    int steps = 500, warm_up = 50, repeats = 3;
    double skin = 3e-5;           // m
    double gravity = 9810;        // m/s2, what holds the shared packs together
    double surface_energy = 60;   // J/m2
    bool json = true;
};

void add_bench(CLI::App& app, BenchOptions& options);
int run_bench(BenchOptions const& options);

} // namespace arenite
