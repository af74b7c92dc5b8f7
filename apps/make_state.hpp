// SPDX-License-Identifier: MIT
// The state of a run's beginning, from the scene.
#pragma once

#include "apps/run_state.hpp"
#include "apps/stage_plan.hpp"

#include <optional>

namespace arenite {

/// Hash of the content of the grain, checkpoint and mesh files that the scene names. Throws InputError.
std::uint64_t hash_of_inputs(Scene const& scene);

/// Walls at their places and grains from a file or a checkpoint; grains of a distribution come with its generation
/// stage. Throws InputError.
RunState make_run_state(Scene const& scene);

/// Makes the grains the state's, with the groups that the scene sorts them into.
void set_particles(Scene const& scene, std::vector<Grain> grains, RunState& state);

/// Puts grains of the scene's size distribution at random places. Throws InputError.
void generate_particles(Scene const& scene, RunState& state);

/// What a checkpoint knows of its fluid, and the scene and the grains may tell no longer.
struct KnownFluid {
    Region box;               // m
    bool with_grains = false; // when it was made
};

/// Makes the fluid when the stage has one and the run does not yet, and lets it go when the stage has none. Its box is that
/// of a checkpoint, or what the scene says with the walls where they are.
void prepare_fluid(Scene const& scene, PlannedStage const& planned, RunState& state,
                   std::optional<KnownFluid> const& known = {});

/// m; the scene-independent 1 m where there is no grain.
Real smallest_grain_diameter(Particles const& particles);

} // namespace arenite
