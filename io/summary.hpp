// SPDX-License-Identifier: MIT
// summary.json: what ran, on what, and how it ended. Values that are not finite are null.
#pragma once

#include "core/vec3.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace arenite {

struct WallSummary {
    std::string name;
    Vec3 force;                 // N, by the grains on the wall, at the end of the stage
    std::optional<Real> stress; // Pa, where the wall has an area
};

struct StageSummary {
    std::string name;
    std::string ended_by;    // "duration", "conditions met", "duration, conditions not met", "stopped"; "" while it runs
    Real wall_time = 0;      // s
    Real simulated_time = 0; // s, in this stage
    std::int64_t steps = 0;
    Real particle_steps = 0; // sum over the steps of the grains present
    std::int64_t grains = 0, contacts = 0, bonds = 0;
    std::optional<Real> porosity, coordination;
    Real kinetic_energy = 0;    // J
    Real max_overlap_ratio = 0; // overlap / radius, the largest of the stage
    Real produced_mass = 0;     // kg, in this stage
    std::int64_t produced_count = 0;
    Real lost_mass = 0; // kg, in this stage, that left the domain other than through the outlet
    std::int64_t lost_count = 0;
    std::vector<WallSummary> walls;
    std::map<std::string, std::int64_t> warnings; // kind -> how often: porosity_limited, overlap, lost_grains, ...
    std::map<std::string, Real> values;           // whatever else the stage has to tell
};

struct RunSummary {
    std::string scene, title; // path and title
    std::uint64_t scene_hash = 0;
    std::uint64_t random_seed = 0;
    std::string outcome; // "done", "stopped", or the message of what ended the run
    std::optional<std::int64_t> resumed_from_step;
    Real wall_time = 0; // s
    int ranks = 1;
    std::string earlier_stages; // of a resumed run: what finished_stages gave; "" none
    std::vector<StageSummary> stages;
};

/// The entries of a folder's summary.json for those of the named stages that ran to their end, as JSON, to be kept by the
/// run that goes on there. "" where there is no summary that can be read.
std::string finished_stages(std::filesystem::path const& folder, std::vector<std::string> const& names);

/// The text of summary.json, build and hardware included.
std::string summary_json(RunSummary const& summary);

/// Writes summary.json in the folder; may be called after each stage.
void write_summary(std::filesystem::path const& folder, RunSummary const& summary);

} // namespace arenite
