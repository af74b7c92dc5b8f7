// SPDX-License-Identifier: MIT
#include "apps/run.hpp"

#include "apps/make_state.hpp"
#include "apps/run_checkpoint.hpp"
#include "apps/stage_loop.hpp"
#include "apps/stop_signal.hpp"
#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/build_info.hpp"
#include "io/checkpoint_folder.hpp"
#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>

namespace arenite {
namespace {

namespace fs = std::filesystem;

Until parse_until(std::string const& text, Scene const& scene)
{
    Until until;
    if (text.empty()) return until;
    Real time = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
    if (error == std::errc() && end == text.data() + text.size()) {
        if (!(time >= 0)) throw InputError(fmt::format("--until {}: a time must not be negative", text));
        until.time = time;
        return until;
    }
    bool const known = std::any_of(scene.stages.begin(), scene.stages.end(), [&](auto const& s) { return s.name == text; });
    if (!known) {
        std::string names;
        for (StageSettings const& stage : scene.stages) names += (names.empty() ? "" : ", ") + stage.name;
        throw InputError(fmt::format("--until {}: neither a time in s nor a stage of the scene ({})", text, names));
    }
    until.stage = text;
    return until;
}

fs::path folder_of(RunOptions const& options)
{
    return options.folder.empty() ? fs::path("runs") / fs::path(options.scene).stem() : fs::path(options.folder);
}

RunState resumed_state(RunOptions const& options, fs::path const& folder, Scene const& scene, StagePlan const& plan)
{
    std::error_code unreadable;
    if (!fs::is_directory(folder, unreadable))
        throw InputError(fmt::format("--resume: there is no run in {}", folder.string()));
    std::vector<std::string> messages;
    std::optional<fs::path> path;
    if (!options.checkpoint.empty()) path = options.checkpoint;
    else {
        std::uint64_t const inputs = hash_of_inputs(scene);
        path = latest_checkpoint(folder, [&](auto const& stamp) { return past_hash(scene, plan, stamp, inputs); }, messages);
    }
    for (std::string const& message : messages) std::fputs(("passed over: " + message + "\n").c_str(), stderr);
    if (!path) throw InputError(fmt::format("--resume: no checkpoint of this scene in {}", folder.string()));
    RunState state = load_checkpoint(*path, scene, plan);
    if (!options.quiet)
        std::fputs(fmt::format("resumed from {}: step {}, {:.6g} s\n", path->string(), state.clock.step, state.clock.time())
                       .c_str(),
                   stdout);
    return state;
}

ResumePoint resume_point(RunState const& state, StagePlan const& plan)
{
    bool const begins = state.clock.stage_step == 0 && state.clock.stage < static_cast<int>(plan.size());
    return {state.clock.step, state.clock.time(), begins ? plan[state.clock.stage].label : ""};
}

/// As a shell takes it for one word.
std::string shell_word(std::string const& text)
{
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,+:@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
    std::string word = "'";
    for (char const c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
}

int stopped_by_signal(RunOptions const& options, fs::path const& folder, RunState const& state, RunOutput& output)
{
    std::string const name = stop_signal() == SIGINT ? "SIGINT" : "SIGTERM";
    output.finish("stopped by " + name);
    std::string command = fmt::format("arenite run {} -o {}", shell_word(options.scene), shell_word(folder.string()));
    for (std::string const& change : options.overrides) command += " --set " + shell_word(change);
    if (!options.until.empty()) command += " --until " + shell_word(options.until);
    std::string const how = can_write_checkpoints() ? fmt::format("to go on: {} --resume", command)
                                                    : "this build writes no checkpoints: it has to begin anew";
    std::fputs(
        fmt::format("stopped by {} after step {}, {:.6g} s; {}\n", name, state.clock.step, state.clock.time(), how).c_str(),
        stderr);
    return 128 + stop_signal();
}

/// Runs the stages; returns how the run ended.
std::string run_stages(Scene const& scene, StagePlan const& plan, Until const& until, RunState& state, RunOutput& output)
{
    while (state.clock.stage < static_cast<int>(plan.size())) {
        PlannedStage const& planned = plan[state.clock.stage];
        std::string const ended = run_stage(scene, planned, until, state, output);
        if (ended == "stopped") {
            output.write_checkpoint(state, false);
            return "stopped";
        }
        state.clock = {state.clock.stage + 1, state.clock.step, 0, state.clock.time(), 0};
        state.tuned_friction = -1;
        output.write_checkpoint(state, true);
        bool const more = state.clock.stage < static_cast<int>(plan.size());
        if (more && (stop_signal() != 0 || until.reached(state.clock.time()))) return "stopped";
        bool const last_part = !more || plan[state.clock.stage].scene_stage != planned.scene_stage;
        if (last_part && scene.stages[planned.scene_stage].name == until.stage) return "stopped";
    }
    return "done";
}

} // namespace

int run_scene(RunOptions const& options)
{
    Scene const scene = read_scene(options.scene, options.overrides);
    StagePlan const plan = make_stage_plan(scene);
    Until const until = parse_until(options.until, scene);
    fs::path const folder = folder_of(options);
    std::error_code unknown;
    if (fs::exists(folder, unknown) && !fs::is_directory(folder, unknown))
        throw InputError(fmt::format("-o {}: is a file; the results need a folder", folder.string()));
    RunState state = options.resume ? resumed_state(options, folder, scene, plan) : make_run_state(scene);
    for (std::string const& message : left_out_messages()) std::fputs((message + "\n").c_str(), stderr);

    std::optional<ResumePoint> resume;
    if (options.resume) resume = resume_point(state, plan);
    RunOutput output(folder, scene, plan, resume, state.clock.stage, options.quiet);
    output.open();
    try {
        StopSignals const signals;
        std::string const outcome = run_stages(scene, plan, until, state, output);
        if (outcome == "stopped" && stop_signal() != 0) return stopped_by_signal(options, folder, state, output);
        output.finish(outcome);
        output.say(fmt::format("{}: {} grains produced, {:.6g} kg; look at {}", outcome, state.tally.produced_count,
                               state.tally.produced_mass, folder.string()));
        return 0;
    } catch (SimulationError const& error) {
        output.finish_after(error.what());
        bool const saved = !list_checkpoints(folder).empty();
        std::string const left = saved ? fmt::format("the last checkpoint in {} is the last good state", folder.string())
                                       : "no checkpoint was due before";
        std::fputs(fmt::format("error: {}\n{}\n", error.what(), left).c_str(), stderr);
        return 1;
    } catch (std::exception const& error) { // who called says it
        output.finish_after(error.what());
        throw;
    }
}

} // namespace arenite
