// SPDX-License-Identifier: MIT
// Looks at the state now and then: what to report, whether the stage is over, whether the run is sound.
#pragma once

#include "apps/energy_account.hpp"
#include "apps/stage_setup.hpp"
#include "core/wall_motion.hpp"

#include <optional>
#include <string>
#include <vector>

namespace arenite {

/// One look at the state, made where velocities and positions are of the same time.
struct Look {
    GrainReport grains;
    ContactReport contacts;
    std::vector<WallReaction> walls; // [wall]
    std::optional<Real> porosity;    // of the sample
    Real wall_overlap_ratio = 0;
    std::optional<EnergySheet> energy; // where a balance is kept
    std::int64_t step = -1;
};

class StageWatch {
public:
    StageWatch(Scene const& scene, PlannedStage const& planned);

    /// The state as it is; made once per step however often it is asked for.
    Look const& look(StageSetup const& setup, RunState& state);

    /// The step of the stage in which its duration ends; 0: it has none.
    std::int64_t last_step() const { return last_step_; }

    /// What ended the stage, if something did. Also turns the friction that a stage tunes.
    std::optional<std::string> has_ended(StageSetup& setup, RunState& state);

    /// Throws SimulationError for forces that are not finite: names the grain.
    void check_health(StageSetup const& setup, RunState& state) const;

    /// dt over the stability limit of the stiffest contact that a look saw, largest so far.
    Real highest_step_ratio() const { return highest_step_ratio_; }
    Real highest_overlap_ratio() const { return highest_overlap_ratio_; }

private:
    bool conditions_hold(StageSetup const& setup, RunState& state);
    bool box_holds_its_stress(StageSetup const& setup, RunState& state) const;
    void tune_friction(StageSetup& setup, RunState& state);
    Real stress_on(std::string const& wall, Real area, StageSetup const& setup, RunState& state);

    Scene const& scene_;
    StageSettings const& stage_;
    std::int64_t last_step_ = 0; // of the stage
    Look look_;
    Real highest_step_ratio_ = 0, highest_overlap_ratio_ = 0;
};

} // namespace arenite
