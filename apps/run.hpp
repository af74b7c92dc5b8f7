// SPDX-License-Identifier: MIT
// `arenite run`: a scene from its first stage, or from a checkpoint, to its end.
#pragma once

#include <string>
#include <vector>

namespace arenite {

struct RunOptions {
    std::string scene;
    std::string folder;                 // "": runs/<name of the scene>
    std::vector<std::string> overrides; // table.key=value
    std::string until;                  // name of a stage, or a time in s
    bool resume = false;
    std::string checkpoint; // "": the newest one in the folder
    bool quiet = false;
};

/// Exit code: 0 done or stopped where `until` says, 1 physics or an output file that cannot be written ended it, 128 + n
/// stopped by signal n (SIGINT, SIGTERM). Throws InputError for bad input: before anything is written, but for what shows
/// only when a stage begins (grains that find no place, say).
int run_scene(RunOptions const& options);

} // namespace arenite
