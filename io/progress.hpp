// SPDX-License-Identifier: MIT
// The line that shows how far a run is: at most once a second, and only on a terminal.
#pragma once

#include "core/real.hpp"

#include <functional>
#include <iosfwd>
#include <string>

namespace arenite {

/// Where the run is.
struct ProgressState {
    std::string stage;
    Real time = 0, end_time = 0; // s, of this stage; an end time of 0: not known
    std::int64_t step = 0;       // of the run
    std::int64_t grains = 0;
};

class Progress {
public:
    using Clock = std::function<double()>; // s

    Progress(); // on stderr if that is a terminal
    Progress(std::ostream& stream, bool shown, Clock clock);
    ~Progress(); // ends the line
    Progress(Progress const&) = delete;
    Progress& operator=(Progress const&) = delete;

    /// Cheap enough for every step.
    void update(ProgressState const& state);

    /// Takes the line away, so that a message can be printed; it comes back with the next update.
    void clear();

private:
    void start_stage(ProgressState const& state, double now);
    std::string line(ProgressState const& state, double now) const;

    std::ostream& stream_;
    bool shown_;
    Clock clock_;
    double begin_ = 0;          // of the run, wall time
    double last_ = -1e9;        // of the last line, wall time
    ProgressState last_state_;  // what it showed
    double stage_begin_ = 0;    // wall time ...
    Real stage_begin_time_ = 0; // ... and simulated time at the first update of the stage
    std::string stage_;
    double rate_ = 0;       // particle-steps/s since the last line
    std::size_t width_ = 0; // of what is on the terminal
};

/// 42 s, 3 min 20 s, 5 h 02 min, 3 d 4 h.
std::string duration_text(double seconds);

} // namespace arenite
