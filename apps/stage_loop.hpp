// SPDX-License-Identifier: MIT
// The stage loop: start here to see what a run does.
#pragma once

#include "apps/run_output.hpp"
#include "apps/run_state.hpp"
#include "apps/stage_forces.hpp"
#include "apps/stage_plan.hpp"

#include <optional>

namespace arenite {

/// Where a run is to stop early; nothing: at its end.
struct Until {
    std::string stage;          // after the stage of this name
    std::optional<Real> time;   // s

    bool reached(Real now) const { return time && now >= *time * (1 - Real(1e-12)); }
};

/// Runs the planned stage that state.clock is in, from its beginning, or from the middle if the state comes from a
/// checkpoint there. Returns what ended it; "stopped": nothing did, the user wants no more. Throws SimulationError with the
/// grain or cell, the step and the cause.
std::string run_stage(Scene const& scene, PlannedStage const& planned, Until const& until, RunState& state,
                      RunOutput& output);

} // namespace arenite
