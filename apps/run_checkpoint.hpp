// SPDX-License-Identifier: MIT
// The whole state of a run in a checkpoint, bit for bit. Written right after both contact lists were searched, so
// that a resumed run, which searches too, has its grains in the same rows as the run that went on.
#pragma once

#include "apps/run_state.hpp"
#include "apps/stage_plan.hpp"

#include <filesystem>

namespace arenite {

/// Throws OutputError if it cannot be written.
void save_checkpoint(std::filesystem::path const& path, Scene const& scene, StagePlan const& plan, RunState& state,
                     bool stage_end);

/// Throws InputError if the file is damaged, foreign, or belongs to another scene.
RunState load_checkpoint(std::filesystem::path const& path, Scene const& scene, StagePlan const& plan);

} // namespace arenite
