// SPDX-License-Identifier: MIT
#include "apps/report.hpp"

#include "core/error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <spawn.h>
#include <string_view>
#include <sys/wait.h>

extern char** environ;

namespace arenite {
namespace {

namespace fs = std::filesystem;

/// Where the Python package lies: beside an installed program, or in the source tree that this was built from.
fs::path package_folder()
{
    std::error_code none;
    fs::path const program = fs::read_symlink("/proc/self/exe", none);
    fs::path const installed = program.parent_path() / ARENITE_REPORT_INSTALLED;
    if (!program.empty() && fs::exists(installed / "arenite_report", none)) return installed.lexically_normal();
    if (fs::exists(fs::path(ARENITE_REPORT_SOURCE) / "arenite_report", none)) return ARENITE_REPORT_SOURCE;
    throw SimulationError(fmt::format("the report's Python files are neither in {} nor in {}",
                                      installed.lexically_normal().string(), ARENITE_REPORT_SOURCE));
}

/// The user's choice, that of the set-up, or what PATH has.
std::string python()
{
    if (char const* const chosen = std::getenv("ARENITE_PYTHON"); chosen && *chosen) return chosen;
    std::error_code none;
    return fs::exists(ARENITE_REPORT_PYTHON, none) ? ARENITE_REPORT_PYTHON : "python3";
}

int run_and_wait(std::vector<std::string> words)
{
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    if (int const error = posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ); error != 0)
        throw SimulationError(
            fmt::format("the report needs Python, and {} cannot be started: {}. ./run.sh installs one into deps/python; "
                        "ARENITE_PYTHON=/path/to/python3 names another",
                        words[0], std::strerror(error)));
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

} // namespace

void add_report(CLI::App& app, ReportOptions& options)
{
    CLI::App* report = app.add_subcommand("report", "report.html with the pictures and tables of one or several runs");
    report->add_option("folders", options.folders, "run folders, side by side")->required();
    report->add_option("-o,--output", options.output,
                       "the page, or a folder for it; report.html in the first folder unless named");
    report->add_option("--measured", options.measured, "CSV of measured points (t, M) to compare with; may be repeated")
        ->allow_extra_args(false);
    report->add_option("--reference", options.reference, "run folder that the others are compared with (the original)");
    report->add_option("--scaling", options.scaling, "CSV of wall times: case, threads, wall_time; may be repeated")
        ->allow_extra_args(false);
}

bool asks_for_report(int argc, char const* const* argv) { return argc > 1 && std::string_view(argv[1]) == "report"; }

int write_report(ReportOptions const& options)
{
    std::vector<std::string> folders = options.folders;
    if (!options.reference.empty()) folders.push_back(options.reference);
    for (std::string const& folder : folders)
        if (!fs::is_directory(folder)) throw InputError(fmt::format("report: there is no folder {}", folder));

    std::vector<std::string> words{python(), "-B", "-m", "arenite_report"};
    auto const pass_on = [&words](std::string const& option, std::string const& value) {
        if (!value.empty()) words.push_back(option + "=" + value);
    };
    pass_on("--output", options.output);
    pass_on("--reference", options.reference);
    for (std::string const& file : options.measured) pass_on("--measured", file);
    for (std::string const& file : options.scaling) pass_on("--scaling", file);
    words.push_back("--");
    words.insert(words.end(), options.folders.begin(), options.folders.end());

    char const* const given = std::getenv("PYTHONPATH");
    std::string const path = package_folder().string() + (given && *given ? std::string(":") + given : "");
    setenv("PYTHONPATH", path.c_str(), 1);
    return run_and_wait(std::move(words));
}

} // namespace arenite
