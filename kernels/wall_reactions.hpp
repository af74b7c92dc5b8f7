// SPDX-License-Identifier: MIT
// What the walls feel.
#pragma once

#include "core/wall_motion.hpp"
#include "kernels/wall_contacts.hpp"

#include <vector>

namespace arenite {

/// Force, torque, stiffness and impedance of every wall from the last evaluation: [wall]. Waits for the device once.
/// Summed by blocks of 64 ids, then of 4096 ids, then all, in the order of (id, element): the bits depend on ids and forces
/// alone, not on threads or on which grains are merely near.
std::vector<WallReaction> measure_walls(Particles const& particles, Walls const& walls, WallContacts const& contacts);

/// Largest overlap over radius of all touching rows; 0 if none touches.
Real largest_wall_overlap_ratio(Particles const& particles, WallContacts const& contacts);

} // namespace arenite
