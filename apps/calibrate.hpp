// SPDX-License-Identifier: MIT
// How fast this machine runs a scene's stages, from a fraction of a second of each.
#pragma once

#include "apps/stage_plan.hpp"

namespace arenite {

/// What a stage costs here: seconds of wall time, and memory.
struct StageCost {
    double step = 0;       // of a grain step, the balance sheet's share included where the scene asks for one
    double search = 0;     // of a rebuild of the contact lists
    double fluid_step = 0; // of a fluid step with its coupling; 0 without fluid
    double memory = 0;     // bytes at most, beside the output's
};

/// Runs the stage's own step for a moment, with the grains that the scene gives or with as many as it will make, packed as
/// densely as in a sample under pressure. Nothing moves meanwhile. Throws InputError, SimulationError.
StageCost measure_stage(Scene const& scene, PlannedStage const& planned);

} // namespace arenite
