// SPDX-License-Identifier: MIT
// VTK's stream tracer behind plain data (no Kokkos, see vtk_pieces.hpp). Without VTK it traces nothing.
#pragma once

#include "io/vtk_pieces.hpp"

namespace arenite {

enum class TraceDirection { both, downstream, upstream };

struct TraceRequest {
    std::vector<double> seeds; // interleaved, m; those outside the grid are passed over
    double max_length = 0;     // m, each way
    double terminal_speed = 0; // m/s: a line ends where the flow is slower
    TraceDirection direction = TraceDirection::both;
};

bool can_trace();

/// Lines along the image's cell data "velocity", with that as point data. VTK gives the points in single
/// precision.
PolyPiece trace(ImagePiece const& image, TraceRequest const& request);

} // namespace arenite
