// SPDX-License-Identifier: MIT
// `arenite report`: starts the Python program in apps/report with the Python that the set-up chose. It needs no Kokkos, so
// that a GPU build's run folders can be looked at where there is no GPU.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace arenite {

struct ReportOptions {
    std::vector<std::string> folders;
    std::string output;    // "": report.html in the first folder
    std::string reference; // the run that the others are compared with
    std::vector<std::string> measured, scaling;
};

void add_report(CLI::App& app, ReportOptions& options);

/// Whether the command line asks for the report, before Kokkos starts.
bool asks_for_report(int argc, char const* const* argv);

/// Exit code of the Python program. Throws InputError for a folder that is not there, SimulationError without a Python.
int write_report(ReportOptions const& options);

} // namespace arenite
