// SPDX-License-Identifier: MIT
// Histories of single grains and cells: probe-NAME.csv, a row whenever history.csv gets one.
#pragma once

#include "apps/run_state.hpp"
#include "io/time_series.hpp"

#include <filesystem>

namespace arenite {

class Probes {
public:
    Probes(std::filesystem::path const& folder, OutputSettings const& output, std::optional<ResumePoint> const& resume);

    /// Empty cells where the grain has left or there is no fluid yet.
    void write(RunState const& state, std::string const& stage);
    void flush();

private:
    struct Probe {
        ProbeSettings settings;
        TimeSeries table;
    };
    std::vector<Probe> probes_;
};

} // namespace arenite
