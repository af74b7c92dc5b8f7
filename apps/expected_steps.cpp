// SPDX-License-Identifier: MIT
#include "apps/expected_steps.hpp"

#include "apps/stage_setup.hpp"
#include "core/wall_motion.hpp"

#include <algorithm>
#include <cmath>

namespace arenite {
namespace {

/// m/s that a wall of the stage may reach; 0 where none moves.
Real fastest_wall(StageSettings const& stage)
{
    Real fastest = 0;
    for (WallAction const& action : stage.walls) {
        if (action.velocity) fastest = std::max(fastest, norm(*action.velocity));
        if (action.servo) fastest = std::max(fastest, action.servo->max_speed);
    }
    return fastest;
}

/// s that the stage's walls need for their travels.
Real longest_travel(StageSettings const& stage)
{
    Real longest = 0;
    for (WallAction const& action : stage.walls)
        if (action.travel && action.velocity)
            longest = std::max(longest, program_duration(action.ramp_time.value_or(0),
                                                         *action.travel / norm(*action.velocity), action.and_back));
    return longest;
}

} // namespace

ExpectedSteps expected_steps(PlannedStage const& planned)
{
    StageSettings const& stage = planned.settings;
    if (!(planned.dt > 0)) return {};
    double const bound = stage.duration > 0 ? std::ceil(stage.duration / planned.dt) : 0;
    auto const within_bound = [&](double steps) {
        return ExpectedSteps{bound > 0 ? std::min(bound, std::ceil(steps)) : std::ceil(steps)};
    };
    if (!stage.end.any()) return {bound};
    EndSettings travel_only;
    travel_only.wall_travel_done = true;
    if (stage.end == travel_only) return within_bound(longest_travel(stage) / planned.dt);
    if (planned.gap > 0) {
        // The plate closes the gap; then friction falls by 3.3 % every hundred steps, to a twentieth, until the pack is as
        // dense as it is to be. This gives 17600 steps for scenes/paper/ssw.toml, 14400 for ssp.toml and 15800 for
        // demo.toml; measured were 17800, 14300 and 6900. Longer stages follow, whose length is known.
        constexpr double tuning = 9000;
        return within_bound(planned.gap / fastest_wall(stage) / planned.dt + tuning);
    }
    // Some crossings of the sample's waves under damping: 2000 steps (ssw, demo), 1200 (ssp).
    if (planned.part == CompressionPart::relax) return within_bound(1600);
    return {bound, true};
}

double expected_search_interval(PlannedStage const& planned)
{
    // Whoever looks for grains that left, every hundred steps, searches anew where it finds some.
    double const rarely = planned.settings.outlet_wall.empty() ? 600 : 120;
    // Of the smallest grain, with half of the skin to go.
    Real const move = 2 * fastest_wall(planned.settings) * planned.dt / planned.limits.smallest_diameter;
    if (!(move > 0)) return rarely;
    double const skin = std::clamp(std::sqrt(balanced_list_age * move), least_relative_skin, most_relative_skin);
    return std::clamp(skin / move, 1.0, rarely);
}

} // namespace arenite
