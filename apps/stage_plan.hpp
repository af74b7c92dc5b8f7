// SPDX-License-Identifier: MIT
// From the scene's stages to what the driver runs: a fast compression becomes the ordinary stages that it
// stands for, time steps and laws are settled, all before anything moves.
#pragma once

#include "core/coarse_graining.hpp"
#include "core/critical_time_step.hpp"
#include "core/scene.hpp"

namespace arenite {

/// What a stage of a fast compression is there for.
enum class CompressionPart { none, densify, press, relax };

struct PlannedStage {
    StageSettings settings; // kind generation or dynamics
    std::string label;      // "compression", or "compression/press" for a part of it
    int scene_stage = 0;    // row of Scene::stages
    CompressionPart part = CompressionPart::none;
    Real porosity = 0; // where a densifying plate stops
    Real gap = 0;      // m by which a press is to make the sample thinner, as far as the scene says it
    TimeStepLimits limits;
    Real grain_friction = 0;    // the largest between grains
    int strictest = -1;         // row of the material whose grains need the shortest step; -1 without grains
    Real dt = 0;                // s
    int coupling_interval = 0;  // grain steps per fluid step; 0 without fluid
    bool keeps_balance = false; // of energies
    int materials = 0;
    std::vector<PairConstants> pairs, wall_pairs; // [material][material]

    PairConstants const& pair(int material, int other) const { return pairs[material * materials + other]; }
};

using StagePlan = std::vector<PlannedStage>;

/// Throws InputError for what only shows when everything is known: a fluid step that is not a whole number of grain
/// steps, a stage without a time step.
StagePlan make_stage_plan(Scene const& scene);

} // namespace arenite
