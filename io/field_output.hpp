// SPDX-License-Identifier: MIT
// The series that ParaView opens: particles.pvd, fluid.pvd, streamlines.pvd and walls.pvd in the run's
// folder. A series is started with its first piece, so that a scene without fluid has no fluid.pvd.
#pragma once

#include "io/pvd.hpp"
#include "io/snapshots.hpp"
#include "io/streamlines.hpp"
#include "io/vtk_pieces.hpp"

#include <map>

namespace arenite {

/// The arrays that can be chosen, in the order in which they are written.
std::vector<std::string> const& grain_fields();
std::vector<std::string> const& fluid_fields();

/// Chosen fields as a piece. Fields that are not known (bonds where there are no contacts, fluid force without fluid) are
/// left out. Throws InputError for a name that is none.
PolyPiece grain_piece(GrainSnapshot const& grains, std::vector<std::string> const& fields = grain_fields());
ImagePiece fluid_piece(FluidSnapshot const& fluid, std::vector<std::string> const& fields = fluid_fields());

/// Lengths of interleaved vectors.
std::vector<Real> speeds(std::vector<Real> const& velocity);

class FieldOutput {
public:
    /// Drops what the series of an earlier run in this folder hold past the resume time (all without one).
    FieldOutput(std::filesystem::path folder, std::optional<ResumePoint> const& resume = {});

    void choose_grain_fields(std::vector<std::string> fields) { grain_choice_ = std::move(fields); }
    void choose_fluid_fields(std::vector<std::string> fields) { fluid_choice_ = std::move(fields); }

    void write(GrainSnapshot const& grains);
    void write(FluidSnapshot const& fluid);
    void write_streamlines(FluidSnapshot const& fluid, StreamlineSettings const& settings);
    void write_walls(PolyPiece const& walls);

private:
    PvdSeries& series(std::string const& name, std::string const& extension);
    void store(std::string const& name, std::string const& extension, Real time, std::string const& content);

    std::filesystem::path folder_;
    std::optional<ResumePoint> resume_;
    std::map<std::string, PvdSeries> series_;
    std::vector<std::string> grain_choice_ = grain_fields(), fluid_choice_ = fluid_fields();
};

} // namespace arenite
