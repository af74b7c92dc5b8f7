// SPDX-License-Identifier: MIT
// The stage loop: start here to see what a run does.
#pragma once

#include "apps/run_output.hpp"
#include "apps/run_state.hpp"
#include "apps/stage_forces.hpp"
#include "apps/stage_plan.hpp"

#include <optional>

namespace arenite {

struct StageSetup;

/// Where a run is to stop early; nothing: at its end.
struct Until {
    std::string stage;        // after the stage of this name
    std::optional<Real> time; // s

    bool reached(Real now) const { return time && now >= *time * (1 - Real(1e-12)); }
};

/// Runs the planned stage that state.clock is in, from its beginning, or from the middle if the state comes from a
/// checkpoint there. Returns what ended it; "stopped": nothing did, the user wants no more. Throws SimulationError with the
/// grain or cell, the step and the cause.
std::string run_stage(Scene const& scene, PlannedStage const& planned, Until const& until, RunState& state,
                      RunOutput& output);

/// In which steps of a stage somebody looks: velocities stand at the time of the positions only there; in between kick and
/// drift are one kernel. A stage ends and grains leave at steps that neither output nor a stop chooses: the bits do not
/// depend on them.
struct Cadence {
    static constexpr int check = 100; // steps
    int fluid = 0;                    // steps; 0: none
    std::int64_t last = 0, until = 0; // steps of the stage, where it or the run ends; 0: none
    OutputCadence output;

    bool checks_at(std::int64_t step) const { return step % check == 0 || step == last; }
    bool stops_at(std::int64_t step) const
    {
        return (fluid > 0 && step % fluid == 0) || checks_at(step) || step == until || output.due(step);
    }
};

/// The grains from one moment at which somebody looks to the next; with the balance sheet where the state keeps one.
void advance(StageSetup& setup, Cadence const& cadence, RunState& state);

/// A fluid step and what it does to the grains.
void advance_fluid(FluidState& fluid, Particles& particles, Real fluid_dt);

} // namespace arenite
