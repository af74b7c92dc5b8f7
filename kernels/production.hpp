// SPDX-License-Identifier: MIT
// Grains that leave the run: through an open hole of the outlet wall (produced), or out of the domain (lost).
#pragma once

#include "core/particles.hpp"
#include "core/periodic_box.hpp"
#include "core/walls.hpp"

namespace arenite {

enum class Leaving : int { stays = 0, produced = 1, lost = 2 };

struct Departures {
    View1<int> keep;             // [grain] 1: stays
    std::vector<Grain> produced; // in the order of their ids
    std::vector<Grain> lost;     // likewise
};

/// Finds the grains that are wholly past an open hole of wall `outlet` (-1: none) or whose centre is outside the
/// domain on an axis that is not periodic (produced if it is in the hole then, else lost). Copies only those that leave to
/// the host. keep is unallocated when none does.
Departures find_departures(Particles const& particles, PeriodicBox const& domain, Walls const& walls, int outlet);

} // namespace arenite
