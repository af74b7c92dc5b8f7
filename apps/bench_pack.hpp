// SPDX-License-Identifier: MIT
// A pack with its laws, ready to step: what `bench` times and `check` calibrates with.
#pragma once

#include "apps/stage_forces.hpp"

#include <string>
#include <vector>

namespace arenite {

struct BenchPack {
    std::vector<Grain> grains;
    Vec3 lower, upper;   // walls at lower x, y, z and upper x, y (the shared packs have no lid), m
    std::string name;
};

/// "x y z radius" lines, m; throws InputError. The side walls are where the grains' extent ends, to 0.1 mm.
BenchPack read_pack(std::string const& path);

/// A simple cubic lattice of about `grains` grains of 0.46 mm, overlapping by 4e-7 m, jittered by 1e-8 m: three contacts a
/// grain, as many as a dense random pack has candidates.
BenchPack lattice_pack(int grains);

struct BenchRun {
    double seconds = 0;             // of the timed steps
    double seconds_evaluate = 0, seconds_integrate = 0, seconds_search = 0;
    long long steps = 0, searches = 0;
    int grains = 0;
    double candidates_per_grain = 0, contacts_per_grain = 0;
    unsigned long long state_hash = 0; // of positions, velocities and spins in the order of the ids

    double particle_steps_per_second() const { return static_cast<double>(grains) * static_cast<double>(steps) / seconds; }
};

struct BenchSettings {
    NormalLaw law = NormalLaw::hertz;
    double surface_energy = 60, gravity = 9810, skin = 3e-5, dt = 1e-8;
    int warm_up = 50, steps = 500;
};

/// Steps the pack in its walls (sand of physics.md section 5, mu 0.2, e 0.8).
BenchRun run_pack(BenchPack const& pack, BenchSettings const& settings);

} // namespace arenite
