// SPDX-License-Identifier: MIT
// Random packs, and the pairs in them by looking at every two grains.
#pragma once

#include "apps/verify/grain_system.hpp"

namespace arenite {

struct PackSettings {
    int count = 0;
    Real box = 1e-2;     // m, edge; grains may overlap
    Real largest = 0;    // m, diameter
    Real size_ratio = 1; // largest over smallest, uniform in the logarithm
    Real speed = 0;      // m/s, most along an axis
    Real spin = 0;       // rad/s, most about an axis
    Real overhang = 0;   // m by which centres may lie outside the box
    std::uint64_t seed = 1;
    bool lattice = false; // jittered lattice sites instead of anywhere
};

std::vector<Grain> random_pack(PackSettings const& settings);

/// `count` rough grains that fly about in a box of so many m, up to `largest` m wide; near each other, for searches and
/// bits.
SystemSettings rough_pack(NormalLaw law, int count, Real box, Real largest, bool periodic);

/// The same grains in another order; ids stay with them.
std::vector<Grain> shuffled(std::vector<Grain> grains, std::uint64_t seed);

/// The offset between the nearest images.
Vec3 nearest_offset(Vec3 offset, PeriodicBox const& box);

/// Pairs that the list has and should not, should have and has not, or has twice, against every two grains
/// of the system as it is now.
int wrong_pairs(GrainSystem const& system);

} // namespace arenite
