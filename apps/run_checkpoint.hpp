// SPDX-License-Identifier: MIT
// The whole state of a run in a checkpoint, bit for bit: the grains in their rows, the contact list as it is, and where
// grains and walls were when it was built, so that a resumed run searches next where the run that went on does.
#pragma once

#include "apps/run_state.hpp"
#include "apps/stage_plan.hpp"
#include "io/checkpoint.hpp"

#include <filesystem>

namespace arenite {

/// About; contacts included. Measured on packs under stress.
inline double checkpoint_bytes(double grains, double fluid_cells) { return 800 * grains + 160 * fluid_cells; }

/// Hash of all that made a state with this stamp: the scene without the stages to come, its output settings and, while a
/// stage runs, when that ends; with inputs, which is hash_of_inputs. 0 if the plan has no such stage.
std::uint64_t past_hash(Scene const& scene, StagePlan const& plan, CheckpointStamp const& stamp, std::uint64_t inputs);

/// Throws OutputError if it cannot be written.
void save_checkpoint(std::filesystem::path const& path, Scene const& scene, StagePlan const& plan, RunState& state,
                     bool stage_end);

/// Throws InputError if the file is damaged, foreign, or belongs to another scene.
RunState load_checkpoint(std::filesystem::path const& path, Scene const& scene, StagePlan const& plan);

} // namespace arenite
