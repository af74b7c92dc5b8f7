// SPDX-License-Identifier: MIT
// The walls as polygons where they are now, for walls.pvd. Planes end at the domain and have their open
// holes cut out; round things are drawn with corners on the circle.
#pragma once

#include "core/walls.hpp"
#include "io/vtk_pieces.hpp"

namespace arenite {

/// The walls that are present; cell data: wall (its row in the scene).
PolyPiece wall_surfaces(Walls const& walls, Real time);

} // namespace arenite
