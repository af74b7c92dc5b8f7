// SPDX-License-Identifier: MIT
// A pack with its laws, ready to step: what `bench` times and `check` calibrates with.
#pragma once

#include "apps/stage_forces.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace arenite {

struct BenchPack {
    std::vector<Grain> grains;
    Vec3 lower, upper; // walls at lower x, y, z and upper x, y (the shared packs have no lid), m
    std::string name;
};

/// The sand of the packs; surface_energy in J/m2.
MaterialSettings bench_sand(double surface_energy);

/// "x y z radius" lines, m; throws InputError. The side walls are where the grains' extent ends, to 0.1 mm.
BenchPack read_pack(std::string const& path);

/// A simple cubic lattice of about `grains` grains of 0.46 mm, overlapping by 4e-7 m, jittered by 1e-8 m: three contacts a
/// grain, as many as a dense random pack has candidates. proportions: of the box's edges.
BenchPack lattice_pack(int grains, std::array<int, 3> const& proportions = {1, 1, 1});

/// Copies of the pack side by side, every other one mirrored, so that grains at the walls between them meet their images.
BenchPack tiled_pack(BenchPack const& pack, int along_x, int along_y);

/// Writes what read_pack reads; throws SimulationError where it cannot.
void write_pack(BenchPack const& pack, std::string const& path);

struct BenchRun {
    double seconds = 0; // of the timed steps
    double seconds_evaluate = 0, seconds_integrate = 0, seconds_search = 0;
    long long steps = 0, searches = 0;
    int grains = 0, tile_grains = 0;
    double candidates_per_grain = 0, contacts_per_grain = 0, gathered_per_grain = 0, shared_per_grain = 0; // rows
    unsigned long long state_hash = 0;    // of positions, velocities and spins in the order of the ids
    double one_search = 0;                // s, of a search after the timed steps
    std::map<std::string, double> memory; // bytes after the timed steps, by View
    double peak_memory = 0;               // bytes, in the search

    double particle_steps_per_second() const { return static_cast<double>(grains) * static_cast<double>(steps) / seconds; }
};

struct BenchSettings {
    NormalLaw law = NormalLaw::hertz;
    double surface_energy = 60, gravity = 9810, skin = 3e-5, dt = 1e-8;
    int warm_up = 50, steps = 500;
    bool whole_steps = false; // no tiles (kernels/contact_passes.hpp)
};

/// Steps the pack in its walls (sand of physics.md section 5, mu 0.2, e 0.8).
BenchRun run_pack(BenchPack const& pack, BenchSettings const& settings);

/// The pack after so many steps under local damping: what has been tiled comes to rest.
BenchPack relaxed_pack(BenchPack const& pack, BenchSettings const& settings, int steps);

} // namespace arenite
