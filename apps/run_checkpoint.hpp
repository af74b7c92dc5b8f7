// SPDX-License-Identifier: MIT
// The whole state of a run in a checkpoint, bit for bit. Written right after both contact lists were searched, so
// that a resumed run, which searches too, has its grains in the same rows as the run that went on.
#pragma once

#include "apps/run_state.hpp"
#include "apps/stage_plan.hpp"
#include "io/checkpoint.hpp"

#include <filesystem>

namespace arenite {

/// Hash of all that made a state with this stamp: the scene without the stages to come, its output settings and, while a
/// stage runs, when that ends; with inputs, which is hash_of_inputs. 0 if the plan has no such stage.
std::uint64_t past_hash(Scene const& scene, StagePlan const& plan, CheckpointStamp const& stamp, std::uint64_t inputs);

/// Throws OutputError if it cannot be written.
void save_checkpoint(std::filesystem::path const& path, Scene const& scene, StagePlan const& plan, RunState& state,
                     bool stage_end);

/// Throws InputError if the file is damaged, foreign, or belongs to another scene.
RunState load_checkpoint(std::filesystem::path const& path, Scene const& scene, StagePlan const& plan);

} // namespace arenite
