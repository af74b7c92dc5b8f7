// SPDX-License-Identifier: MIT
// The command line: arenite run | check | verify | bench | report | info.
#include "apps/bench.hpp"
#include "apps/check.hpp"
#include "apps/kernel_times.hpp"
#include "apps/report.hpp"
#include "apps/run.hpp"
#include "apps/verify/verify.hpp"
#include "core/error.hpp"
#include "io/build_info.hpp"

#include <CLI/CLI.hpp>
#include <Kokkos_Core.hpp>
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

using namespace arenite;

struct Command {
    RunOptions run;
    std::string check_scene;
    std::vector<std::string> check_overrides;
    std::string verify_group;
    bool verify_json = false;
    BenchOptions bench;
    bool kernel_times = false;
    ReportOptions report;
};

CLI::App* add_run(CLI::App& app, RunOptions& options)
{
    CLI::App* run = app.add_subcommand("run", "run a scene");
    run->add_option("scene", options.scene, "scene file (TOML)")->required();
    run->add_option("-o,--output", options.folder, "folder for the results; runs/<scene> unless named");
    run->add_option("--set", options.overrides, "table.key=value, over what the scene says")
        ->allow_extra_args(false)
        ->take_all();
    run->add_option("--until", options.until, "stop after this stage or at this time (s)");
    run->add_option("--resume", options.checkpoint, "go on from the newest checkpoint, or from this one")->expected(0, 1);
    run->add_flag("-q,--quiet", options.quiet, "say nothing but warnings and errors");
    return run;
}

/// Several processes would write over each other's files: there is no domain decomposition yet.
void refuse_ranks()
{
    for (char const* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"}) {
        char const* const size = std::getenv(variable);
        if (size && std::atoi(size) > 1)
            throw InputError(fmt::format("started as one of {} MPI ranks: this version runs on one rank; use threads "
                                         "(--kokkos-num-threads) or a GPU",
                                         size));
    }
}

int verify(std::string const& group, bool json)
{
    std::vector<VerifyCase> const cases = run_verification(group);
    std::fputs((json ? verification_json(cases) : verification_table(cases)).c_str(), stdout);
    return all_pass(cases) ? 0 : 1;
}

int dispatch(CLI::App& app, Command& command)
{
    if (auto* run = app.get_subcommand("run"); run->parsed()) {
        command.run.resume = run->get_option("--resume")->count() > 0;
        return run_scene(command.run);
    }
    if (app.get_subcommand("check")->parsed()) return check_scene(command.check_scene, command.check_overrides);
    if (app.get_subcommand("verify")->parsed()) return verify(command.verify_group, command.verify_json);
    if (app.get_subcommand("bench")->parsed()) return run_bench(command.bench);
    if (app.get_subcommand("report")->parsed()) return write_report(command.report);
    std::fputs(describe_build().c_str(), stdout);
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app{"Arenite: sand production from weakly cemented sandstone, grains and water"};
    app.require_subcommand(1);
    Command command;
    CLI::App* const run = add_run(app, command.run);
    CLI::App* check = app.add_subcommand("check", "validate a scene and print what would run");
    check->add_option("scene", command.check_scene, "scene file (TOML)")->required();
    check->add_option("--set", command.check_overrides, "table.key=value")->allow_extra_args(false)->take_all();
    CLI::App* verify = app.add_subcommand("verify", "compare with closed forms");
    verify->add_option("group", command.verify_group, "only this group");
    verify->add_flag("--json", command.verify_json, "machine-readable output");
    add_bench(app, command.bench);
    for (CLI::App* const timed : {run, app.get_subcommand("bench")})
        timed->add_flag("--kernel-times", command.kernel_times, "wall time by phase and kernel at the end; slows GPU runs");
    add_report(app, command.report);
    app.add_subcommand("info", "version, backends, devices, optional parts");

    try {
        refuse_ranks();
        std::signal(SIGXFSZ, SIG_IGN); // a limit on the size of files is then a write that fails, with a message
        // Unbound threads are the default; said aloud, Kokkos does not ask for it at every start.
        setenv("OMP_PROC_BIND", "false", 0);
        // Its cases are small: a second thread gains nothing, and loses much where another program has the core.
        if (argc > 1 && std::strcmp(argv[1], "verify") == 0 && !std::getenv("OMP_NUM_THREADS"))
            setenv("KOKKOS_NUM_THREADS", "1", 0);
        if (!asks_for_report(argc, argv))
            Kokkos::initialize(argc, argv); // takes its own options (--kokkos-num-threads) away
        auto const named = [&](CLI::App const* command_of) { return command_of->get_name() == argv[1]; };
        if (argc > 1 && argv[1][0] != '-' && app.get_subcommands(named).empty())
            throw InputError(
                fmt::format("arenite: there is no command '{}': run, check, verify, bench, report, info", argv[1]));
        app.parse(argc, argv);
        if (command.kernel_times) start_kernel_times();
        int const code = dispatch(app, command);
        if (command.kernel_times) std::fputs(finish_kernel_times().c_str(), stdout);
        if (Kokkos::is_initialized()) Kokkos::finalize();
        return code;
    } catch (CLI::ParseError const& error) {
        if (Kokkos::is_initialized()) Kokkos::finalize();
        int const code = app.exit(error);
        return code == 0 ? 0 : 2;
    } catch (InputError const& error) {
        std::fputs(fmt::format("{}\n", error.what()).c_str(), stderr);
        if (Kokkos::is_initialized()) Kokkos::finalize();
        return 2;
    } catch (std::exception const& error) {
        std::fputs(fmt::format("error: {}\n", error.what()).c_str(), stderr);
        if (Kokkos::is_initialized()) Kokkos::finalize();
        return 1;
    }
}
