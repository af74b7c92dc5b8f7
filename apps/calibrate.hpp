// SPDX-License-Identifier: MIT
// How fast this machine runs this build, from a calibration of about a second.
#pragma once

#include "apps/stage_plan.hpp"

namespace arenite {

struct Calibration {
    double hertz = 1, jkr = 1;          // particle-steps/s
    double fluid_cells_per_second = 1e5; // cells advanced by a fluid step, with coupling

    double particle_steps_per_second(PlannedStage const& stage) const
    {
        return stage.settings.contact.normal == NormalLaw::hertz ? hertz : jkr;
    }
};

Calibration calibrate();

} // namespace arenite
