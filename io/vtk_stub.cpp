// SPDX-License-Identifier: MIT
// Built where VTK is left out: fields go through our own plain writer, streamlines are not traced.
#include "io/stream_tracer.hpp"

namespace arenite {

std::string encode(PolyPiece const& piece) { return encode_plain(piece); }

std::string encode(ImagePiece const& piece) { return encode_plain(piece); }

bool can_trace() { return false; }

PolyPiece trace(ImagePiece const& image, TraceRequest const&)
{
    PolyPiece lines;
    lines.kind = CellKind::lines;
    lines.time = image.time;
    return lines;
}

} // namespace arenite
