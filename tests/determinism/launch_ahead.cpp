// SPDX-License-Identifier: MIT
// The host may look at what the device says as late as it likes: same bits. On a GPU it is late of itself; here it is
// made to be.
#include "apps/make_state.hpp"
#include "apps/stage_loop.hpp"
#include "apps/verify/packs.hpp"
#include "io/scene_reader.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace arenite {
namespace {

namespace fs = std::filesystem;

/// Steps of a GrainSystem with a look at the notice every `look_interval`-th, launched ahead in between.
void advance_ahead(GrainSystem& system, int steps, int look_interval)
{
    StepSettings step;
    step.dt = system.settings.dt;
    step.allowed_move = system.settings.skin / 2;
    system.integrator.look_interval = look_interval;
    drift(system.integrator, step, system.particles, system.contacts);
    for (int made = 1;; ++made) {
        bool const last = made == steps;
        if (last || says_stale(system.integrator)) {
            int const in_vain = take_stale(system.integrator);
            if (in_vain >= 0) {
                made -= in_vain;
                rebuild(system);
            }
        }
        evaluate(system);
        if (made == steps) return kick(system.integrator, step, system.particles, system.contacts, {});
        kick_and_drift(system.integrator, step, system.particles, system.contacts, {});
    }
}

TEST(LaunchAhead, GrainsAreTheSameForAnyLook)
{
    PackSettings pack;
    pack.count = 400;
    pack.box = 2e-3;
    pack.largest = 0.25e-3;
    pack.speed = 2;
    pack.lattice = true;
    SystemSettings settings;
    settings.grains = random_pack(pack);
    settings.materials = {with(sand(), 0.8, 0.3)};
    settings.contact = contact_settings(NormalLaw::modified_jkr, DampingLaw::restitution, TangentialLaw::secant);
    settings.skin = 1e-5;
    settings.dt = 2e-8;
    settings.start_bonded = true;
    settings.fused = true;
    constexpr int steps = 1000;
    GrainSystem waiting = make_system(settings);
    advance(waiting, steps);
    ASSERT_GT(waiting.rebuilds, 5);
    for (int const look_interval : {1, 3, 64, steps + 1}) {
        GrainSystem ahead = make_system(settings);
        advance_ahead(ahead, steps, look_interval);
        EXPECT_EQ(ahead.rebuilds, waiting.rebuilds) << look_interval;
        EXPECT_EQ(state_hash(ahead), state_hash(waiting)) << look_interval;
    }
}

struct Case {
    std::string name, scene;
    bool balance;
};

/// The scene up to its production, if it has one.
RunState run_case(Case const& which, int look_interval, std::int64_t& searches)
{
    Scene const scene = read_scene(ARENITE_TEST_SCENES "/" + which.scene,
                                   {which.balance ? "output.energies=true" : "output.energies=false"});
    StagePlan const plan = make_stage_plan(scene);
    RunState state = make_run_state(scene);
    state.integrator.look_interval = look_interval;
    fs::path const folder = fs::temp_directory_path() / "arenite_launch_ahead";
    {
        RunOutput output(folder, scene, plan, {}, 0, true);
        output.open();
        for (PlannedStage const& planned : plan) {
            if (planned.label == "production") break;
            run_stage(scene, planned, {}, state, output);
            state.clock = {state.clock.stage + 1, state.clock.step, 0, state.clock.time(), 0};
        }
    }
    searches = state.last_search;
    fs::remove_all(folder);
    return state;
}

template <class Records> bool same_bits(Records const& a, Records const& b, int count)
{
    auto const left = Kokkos::create_mirror_view_and_copy(HostSpace(), a),
               right = Kokkos::create_mirror_view_and_copy(HostSpace(), b);
    return std::memcmp(left.data(), right.data(), static_cast<std::size_t>(count) * 4 * sizeof(Real)) == 0;
}

class LaunchAheadStages : public testing::TestWithParam<Case> {};

TEST_P(LaunchAheadStages, AreTheSameForAnyLook)
{
    bool const balance = GetParam().balance;
    std::int64_t last_search = 0, last_search_late = 0;
    RunState const prompt = run_case(GetParam(), 1, last_search), late = run_case(GetParam(), 64, last_search_late);
    EXPECT_EQ(last_search, last_search_late);
    ASSERT_EQ(prompt.clock.step, late.clock.step);
    ASSERT_EQ(prompt.particles.count, late.particles.count);
    EXPECT_TRUE(same_bits(prompt.particles.position, late.particles.position, prompt.particles.count));
    EXPECT_TRUE(same_bits(prompt.particles.velocity, late.particles.velocity, prompt.particles.count));
    EXPECT_TRUE(same_bits(prompt.particles.spin, late.particles.spin, prompt.particles.count));
    EXPECT_EQ(prompt.box.upper, late.box.upper);
    ASSERT_EQ(prompt.energy.has_value(), balance);
    if (!balance) return;
    WorkSums const on_time = prompt.energy->read_sums(), ahead = late.energy->read_sums();
    EXPECT_NE(on_time.work[Work::normal_damping], 0);
    for (int n = 0; n < work_count; ++n) EXPECT_EQ(on_time.work.values[n], ahead.work.values[n]) << n;
    EXPECT_EQ(on_time.adhesion, ahead.adhesion);
}

// small: a servo's wall, then a rod that goes down and comes up. periodic: a box under a rate and a stress, then a lid.
INSTANTIATE_TEST_SUITE_P(Of, LaunchAheadStages,
                         testing::Values(Case{"WallsThatMove", "small.toml", false},
                                         Case{"WallsThatMoveInBalance", "small.toml", true},
                                         Case{"ABoxThatDeforms", "periodic.toml", false},
                                         Case{"ABoxThatDeformsInBalance", "periodic.toml", true}),
                         [](auto const& info) { return info.param.name; });

} // namespace
} // namespace arenite
