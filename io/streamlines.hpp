// SPDX-License-Identifier: MIT
// Lines along the fluid velocity, traced by VTK (Runge-Kutta 4-5, adaptive).
#pragma once

#include "core/scene.hpp"
#include "io/snapshots.hpp"
#include "io/stream_tracer.hpp"

namespace arenite {

/// The points named, then those on the line, then those on the disc (spread evenly: Vogel's spiral).
std::vector<Vec3> streamline_seeds(StreamlineSettings const& settings);

/// Lines from the seeds that lie in the fluid, with point data velocity [m/s] and speed [m/s]. A flow at
/// rest, no seed inside, or a build without VTK gives a piece without lines, which is a valid file.
PolyPiece trace_streamlines(FluidSnapshot const& fluid, StreamlineSettings const& settings,
                            TraceDirection direction = TraceDirection::both);

} // namespace arenite
