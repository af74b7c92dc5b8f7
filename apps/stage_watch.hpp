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
    Real wall_elastic = 0; // J

    Real elastic_energy() const { return contacts.energy() + wall_elastic; } // J, above the force-free state
    std::optional<EnergySheet> energy;                                       // where a balance is kept
    std::int64_t step = -1;
};

class StageWatch {
public:
    StageWatch(Scene const& scene, PlannedStage const& planned);

    /// The state as it is; made once per step however often it is asked for.
    Look const& look(StageSetup const& setup, RunState& state);

    /// The state changed within a step: grains left.
    void forget_look() { look_.step = -1; }

    /// The step of the stage in which its duration ends; 0: it has none.
    std::int64_t last_step() const { return last_step_; }

    /// What ended the stage, if something did. Also turns the friction that a stage tunes.
    std::optional<std::string> has_ended(StageSetup& setup, RunState& state);

    /// Throws SimulationError for a flow or forces that are not finite: names the grain.
    void check_health(StageSetup const& setup, RunState& state) const;

private:
    bool conditions_hold(StageSetup const& setup, RunState& state);
    bool box_holds_its_stress(StageSetup const& setup, RunState& state) const;
    void tune_friction(StageSetup& setup, RunState& state);
    Real stress_on(std::string const& wall, Real area, StageSetup const& setup, RunState& state);

    Scene const& scene_;
    StageSettings const& stage_;
    std::int64_t last_step_ = 0; // of the stage
    Look look_;
};

} // namespace arenite
