// SPDX-License-Identifier: MIT
// What a stage needs beside the state, and the small steps that the loop is made of.
#pragma once

#include "apps/run_output.hpp"
#include "apps/run_state.hpp"
#include "apps/stage_forces.hpp"
#include "apps/stage_plan.hpp"

namespace arenite {

/// Where the host was when it last knew the grains' steps to be made: it moves the walls and the box of steps that are only
/// launched.
struct LastKnown {
    std::int64_t step = -1;
    std::vector<WallState> walls; // only where walls move
    PeriodicBox box;
};

/// The skin over the smallest diameter: within these, and so that the list lasts balanced_list_age steps divided by it.
inline constexpr Real least_relative_skin = 0.01, most_relative_skin = 0.3, balanced_list_age = 20;

struct StageSetup {
    PlannedStage const* planned = nullptr;
    StageForces forces;
    StepSettings step;
    int carrier = -1; // wall whose motion strains the sample, or -1
    int outlet = -1;  // wall, or -1
    bool walls_move = false;
    LastKnown known;
    Real smallest_diameter = 1;         // m, of the scene's grains
    Real least_skin = 0, most_skin = 0; // m
    std::int64_t searches = 0;
    double search_time = 0; // s of wall time, all of them
};

/// Walls act, contacts are searched, bonds form, forces are evaluated: the state is ready for its first step.
StageSetup begin_stage(Scene const& scene, PlannedStage const& planned, RunState& state);

/// The same for a state that was in the middle of the stage.
StageSetup resume_stage(Scene const& scene, PlannedStage const& planned, RunState& state);

/// Binds the laws anew with another friction between grains (below 0: the materials' own).
void set_friction(StageSetup& setup, RunState& state, Real friction);

/// Both contact lists from the positions as they are.
void search(StageSetup& setup, RunState& state);
void search(StageSetup& setup, RunState& state, View1<int> const& keep);

/// The grains have drifted: time, walls and lists follow. Searches if a grain or a wall used up its share of the skin. The
/// clock may go back, to the step whose list was stale: what was launched since did nothing. must_know: the host looks at
/// the state in this step, so all steps have to be made. The skin follows how long lists last; one that lasts much too long
/// is replaced by one with a smaller skin.
void follow_drift(StageSetup& setup, RunState& state, bool must_know);

/// Lets the servos look at the forces of this step, if it is their turn.
void drive_servos(StageSetup const& setup, RunState& state);

/// Takes grains that left out of the run and writes them to the ledger. True if there were any.
bool remove_departed(StageSetup& setup, RunState& state, RunOutput& output);

} // namespace arenite
