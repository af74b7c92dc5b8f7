// SPDX-License-Identifier: MIT
// SIGINT and SIGTERM (a batch scheduler's last warning) ask a run to stop; the run looks at a flag between two batches of
// steps, where it stops soundly. A second signal, a second or more after the first, ends the process at once: timeout(1) and
// others send theirs to the process and to its group, so that it comes twice.
#pragma once

namespace arenite {

/// The signal that asked for a stop, or 0.
int stop_signal();

/// While one lives the signals are caught; a signal that the process was started to ignore (nohup) stays ignored.
class StopSignals {
public:
    StopSignals();
    ~StopSignals();
    StopSignals(StopSignals const&) = delete;
    StopSignals& operator=(StopSignals const&) = delete;
};

} // namespace arenite
