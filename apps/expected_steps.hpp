// SPDX-License-Identifier: MIT
// How many steps a stage will take, as far as that is known before it runs.
#pragma once

#include "apps/stage_plan.hpp"

namespace arenite {

struct ExpectedSteps {
    double count = 0;
    bool is_bound = false; // nobody knows when the conditions will hold: the stage's duration, 0 without one
};
ExpectedSteps expected_steps(PlannedStage const& planned);

/// Steps between two rebuilds of the contact lists, from the fastest wall and the range that the skin adapts in.
double expected_search_interval(PlannedStage const& planned);

} // namespace arenite
