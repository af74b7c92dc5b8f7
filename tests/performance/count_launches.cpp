// SPDX-License-Identifier: MIT
// What a grain step asks of the device, counted through Kokkos Tools, so on any backend: kernels launched, and moments
// at which the host waits (a fence, a copy, a reduction to a number). A GPU of moderate size spends its time on these.
#include "apps/run.hpp"

#include <Kokkos_Core.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace {

namespace Tools = Kokkos::Tools::Experimental;
using arenite::RunOptions;

/// Why the host may wait in a step.
struct Step {
    int launches = 0, waits = 0;
    bool searches = false; // the lists are renewed
    bool stops = false;    // the host waits after it too: output, a fluid step, the look at the state every 100 steps
    bool servos = false;   // a servo looks at its force, or a box at its stress
    bool over = true;
};

struct StageCount {
    std::int64_t steps = 0, searches = 0, stops = 0, launches = 0, waits = 0; // of steps that do not search
    std::int64_t unexplained_waits = 0;                                       // nor stop, nor serve a servo
    int most_launches = 0;                                                    // of these
    std::int64_t servo_steps = 0, servo_waits = 0;                            // that do not stop
};

struct Listener {
    std::vector<std::string> phases; // open ones; the first is the stage
    Step step;
    std::string step_of; // stage of a step that is over and not counted yet
    int copies = 0;      // open ones: the fences in them are theirs
    std::map<std::string, StageCount> stages;
};
Listener listener; // Kokkos' callbacks are plain functions

void count_step(StageCount& stage, Step const& step)
{
    ++stage.steps;
    stage.searches += step.searches;
    stage.stops += step.stops;
    if (step.searches) return;
    stage.launches += step.launches;
    stage.waits += step.waits;
    if (step.stops) return;
    if (step.servos) {
        ++stage.servo_steps;
        stage.servo_waits += step.waits;
        return;
    }
    stage.unexplained_waits += step.waits;
    stage.most_launches = std::max(stage.most_launches, step.launches);
}

/// Once it is known whether the host waits before the next.
void close_step()
{
    if (!listener.step_of.empty()) count_step(listener.stages[listener.step_of], listener.step);
    listener.step_of.clear();
}

void begin_phase(char const* name)
{
    listener.phases.emplace_back(name);
    if (listener.phases.back() == "grain step") {
        close_step();
        listener.step = {};
        listener.step.over = false;
    }
    if (listener.phases.back() == "contact search") listener.step.searches = true;
    if (listener.phases.back() == "wall reactions" || listener.phases.back() == "box stress") listener.step.servos = true;
}
void end_phase()
{
    std::string const name = listener.phases.back();
    listener.phases.pop_back();
    if (name == "grain step") {
        listener.step.over = true;
        listener.step_of = listener.phases.front();
    }
    if (listener.phases.empty()) close_step();
}
void wait()
{
    if (listener.step.over) listener.step.stops = true;
    else ++listener.step.waits;
}
void launch(char const*, std::uint32_t, std::uint64_t*)
{
    if (!listener.step.over) ++listener.step.launches;
}
void launch_and_wait(char const* name, std::uint32_t device, std::uint64_t* id)
{
    launch(name, device, id);
    wait();
}
void begin_copy(Kokkos::Tools::SpaceHandle, char const*, void const*, Kokkos::Tools::SpaceHandle, char const*, void const*,
                std::uint64_t)
{
    wait();
    ++listener.copies;
}
void end_copy() { --listener.copies; }
void fence(char const* name, std::uint32_t, std::uint64_t*)
{
    if (listener.copies == 0 && !std::strstr(name, "Kokkos Profile Tool Fence")) wait();
}

Tools::EventSet callbacks()
{
    Tools::EventSet set{};
    set.begin_parallel_for = launch;
    set.begin_parallel_reduce = set.begin_parallel_scan = launch_and_wait;
    set.begin_deep_copy = begin_copy;
    set.end_deep_copy = end_copy;
    set.begin_fence = fence;
    set.push_region = begin_phase;
    set.pop_region = end_phase;
    return set;
}

/// All stages of a test scene.
std::map<std::string, StageCount> count_stages(std::string const& scene, bool balance)
{
    RunOptions options;
    options.scene = ARENITE_TEST_SCENES "/" + scene;
    options.folder = (std::filesystem::temp_directory_path() / "arenite_count_launches").string();
    options.overrides = {balance ? "output.energies=true" : "output.energies=false"};
    options.quiet = true;
    listener = {};
    Tools::set_callbacks(callbacks());
    EXPECT_EQ(arenite::run_scene(options), 0);
    Tools::set_callbacks({});
    std::filesystem::remove_all(options.folder);
    std::printf("%-22s %8s %8s %14s %14s\n", balance ? "stage, in balance" : "stage", "steps", "searches", "launches/step",
                "waits/step");
    for (auto const& [name, stage] : listener.stages) {
        double const plain = static_cast<double>(stage.steps - stage.searches);
        std::printf("%-22s %8lld %8lld %14.3f %14.4f\n", name.c_str(), static_cast<long long>(stage.steps),
                    static_cast<long long>(stage.searches), static_cast<double>(stage.launches) / plain,
                    static_cast<double>(stage.waits) / plain);
    }
    // Else its waits would be excused.
    for (auto const& [name, stage] : listener.stages) EXPECT_LT(10 * stage.stops, stage.steps) << name;
    return listener.stages;
}

/// Counted once.
std::map<std::string, StageCount> const& counts()
{
    static std::map<std::string, StageCount> const stages = count_stages("small.toml", false);
    return stages;
}
std::map<std::string, StageCount> const& counts_in_balance()
{
    static std::map<std::string, StageCount> const stages = count_stages("small.toml", true);
    return stages;
}

TEST(CountLaunches, EveryStageThatStepsIsSeen)
{
    std::int64_t steps = 0;
    for (auto const& [name, stage] : counts()) steps += stage.steps;
    ASSERT_EQ(counts().count("production"), 1u);
    EXPECT_GT(counts().at("production").steps, 100);
    EXPECT_GT(steps, 10000);
}

TEST(CountLaunches, AGrainStepIsAtMostSixLaunches)
{
    for (auto const& [name, stage] : counts()) {
        EXPECT_LE(stage.most_launches, 4) << name; // walls' poses, contacts, wall contacts, kick and drift
        EXPECT_LE(static_cast<double>(stage.launches), 6.0 * static_cast<double>(stage.steps - stage.searches)) << name;
    }
    EXPECT_LE(counts().at("production").most_launches, 3); // its walls stand still
}

TEST(CountLaunches, TheHostWaitsOnlyWhereItLooks)
{
    for (auto const& [name, stage] : counts()) EXPECT_EQ(stage.unexplained_waits, 0) << name;
}

TEST(CountLaunches, ABalanceSheetMakesNobodyWait)
{
    ASSERT_EQ(counts_in_balance().count("production"), 1u);
    EXPECT_EQ(counts_in_balance().at("production").steps, counts().at("production").steps);
    for (auto const& [name, stage] : counts_in_balance()) {
        EXPECT_EQ(stage.unexplained_waits, 0) << name;
        EXPECT_EQ(stage.servo_waits, 2 * stage.servo_steps) << name;
    }
}

TEST(CountLaunches, ABoxThatDeformsWaitsTwiceALook)
{
    std::map<std::string, StageCount> const stages = count_stages("periodic.toml", true);
    ASSERT_EQ(stages.count("stir"), 1u);
    EXPECT_GT(stages.at("stir").servo_steps, 10);
    for (auto const& [name, stage] : stages) {
        EXPECT_EQ(stage.unexplained_waits, 0) << name;
        EXPECT_EQ(stage.servo_waits, 2 * stage.servo_steps) << name;
    }
}

TEST(CountLaunches, AServoWaitsTwiceALook)
{ // for the steps that were launched, since it may be that some did nothing, and for what the walls feel
    std::int64_t looks = 0;
    for (auto const& [name, stage] : counts()) {
        looks += stage.servo_steps;
        EXPECT_EQ(stage.servo_waits, 2 * stage.servo_steps) << name;
    }
    EXPECT_GT(looks, 1000);
}

} // namespace
