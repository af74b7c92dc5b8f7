// SPDX-License-Identifier: MIT
// The three kinds of trouble: bad input (InputError, exit code 2), a run that physics ended
// (SimulationError, exit code 1), and a mistake of ours (ARENITE_REQUIRE).
#pragma once

#include <stdexcept>
#include <string>

namespace arenite {

/// The user's scene, file or command line is wrong. what() is complete: every fault, one a line.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The run cannot go on: what() names the grain or cell, the step and the cause.
struct SimulationError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

[[noreturn]] inline void fail_requirement(char const* condition, std::string const& message, char const* file, int line)
{
    throw std::logic_error(std::string(file) + ":" + std::to_string(line) + ": " + message + " (" + condition + ")");
}

} // namespace arenite

#define ARENITE_REQUIRE(condition, message)                                                                                 \
    do {                                                                                                                    \
        if (!(condition)) ::arenite::fail_requirement(#condition, message, __FILE__, __LINE__);                             \
    } while (false)
