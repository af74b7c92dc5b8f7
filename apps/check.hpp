// SPDX-License-Identifier: MIT
// `arenite check`: what a scene would run, before it runs.
#pragma once

#include <string>
#include <vector>

namespace arenite {

/// Prints every resolved value, grain counts by class, critical steps, grid ratios, memory, output size and expected
/// wall time. Exit code 0; throws InputError for a scene that cannot run.
int check_scene(std::string const& path, std::vector<std::string> const& overrides);

} // namespace arenite
