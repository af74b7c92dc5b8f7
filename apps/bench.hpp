// SPDX-License-Identifier: MIT
// `arenite bench`: particle-steps/s of a pack under a law, one JSON line per result.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace arenite {

struct BenchOptions {
    std::string pack;          // text file of "x y z radius" lines, m; "": a lattice that is made
    std::string law = "hertz"; // hertz or jkr
    int grains = 33752;        // of the lattice
    int steps = 500, warm_up = 50, repeats = 3;
    double skin = 3e-5;         // m
    double gravity = 9810;      // m/s2, what holds the shared packs together
    double surface_energy = 60; // J/m2
    std::vector<int> tiles;     // copies along x and y
    int relax = 0;              // steps under damping before anything else
    std::string save;           // where the pack that is then measured is written
    bool whole_steps = false;   // no tiles
    bool limits = false;        // measure what the machine can do too
    bool json = true;
};

void add_bench(CLI::App& app, BenchOptions& options);
int run_bench(BenchOptions const& options);

} // namespace arenite
