// SPDX-License-Identifier: MIT
// The sample between its walls, and grains that leave it.
#include "apps/sample.hpp"
#include "kernels/production.hpp"
#include "tests/wall_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace arenite {
namespace {

using namespace test;

WallSettings tube(Vec3 const& base, Vec3 const& axis, Real diameter)
{
    WallSettings wall;
    wall.name = "tube";
    wall.material = "sand";
    wall.shape = WallShape::cylinder;
    wall.inside = true;
    wall.base = base;
    wall.axis = axis;
    wall.diameter = diameter;
    return wall;
}

Walls in_the_box(std::vector<WallSettings> const& settings, PeriodicBox const& box)
{
    return make_walls(settings, {{"sand"}, box.lower, box.upper, {}});
}

TEST(Sample, IsWhatPlanesVesselsAndTubesLeaveOfTheDomain)
{
    PeriodicBox const box{{0, 0, 0}, {4, 4, 4}};
    auto const volume = [&](std::vector<WallSettings> const& walls) { return sample_volume(in_the_box(walls, box), box); };
    EXPECT_EQ(volume({}), 64);
    EXPECT_EQ(volume({plane({0, 0, 3}, {0, 0, -1}), plane({0, 0, 1}, {0, 0, 1}, "floor")}), 32);
    EXPECT_EQ(volume({box_wall({1, 1, 1}, {3, 3, 3}, true)}), 8);
    EXPECT_EQ(volume({box_wall({1, 1, 1}, {3, 3, 3}, false)}), 64) << "a solid box holds nothing";
    EXPECT_NEAR(volume({tube({2, 2, 1}, {0, 0, 2}, 2)}), 2 * std::numbers::pi, 1e-14);
    EXPECT_NEAR(volume({tube({2, 2, 3}, {0, 0, -2}, 4), plane({0, 0, 2}, {0, 0, -1})}), 4 * std::numbers::pi, 1e-14);
}

TEST(Sample, AGrainStandsClearOfEveryWall)
{
    PeriodicBox const box{{0, 0, 0}, {4, 4, 4}};
    auto const clear = [&](WallSettings const& wall, Vec3 const& x) {
        return stands_clear(in_the_box({wall}, box), x, 0.5);
    };
    EXPECT_TRUE(clear(plane({0, 0, 1}, {0, 0, 1}), {1, 1, 1.5}));
    EXPECT_FALSE(clear(plane({0, 0, 1}, {0, 0, 1}), {1, 1, 1.49}));
    EXPECT_FALSE(clear(plane({0, 0, 1}, {0, 0, 1}), {1, 1, 0})) << "behind it";
    EXPECT_TRUE(clear(box_wall({1, 1, 1}, {3, 3, 3}, true), {1.5, 2, 2.5}));
    EXPECT_FALSE(clear(box_wall({1, 1, 1}, {3, 3, 3}, true), {1.4, 2, 2.5}));
    EXPECT_TRUE(clear(box_wall({1, 1, 1}, {3, 3, 3}, false), {0.5, 2, 2.5}));
    EXPECT_FALSE(clear(box_wall({1, 1, 1}, {3, 3, 3}, false), {2, 2, 2}));
    EXPECT_TRUE(clear(tube({2, 2, 0}, {0, 0, 4}, 2), {2.5, 2, 2}));
    EXPECT_FALSE(clear(tube({2, 2, 0}, {0, 0, 4}, 2), {2.6, 2, 2}));
    EXPECT_FALSE(clear(tube({2, 2, 0}, {0, 0, 4}, 2), {3.6, 2, 2})) << "outside of it";
    WallSettings away = plane({0, 0, 1}, {0, 0, 1});
    away.present = false;
    EXPECT_TRUE(clear(away, {1, 1, 0}));
}

TEST(Sample, AnOutletInTheDomainsFaceProduces)
{
    PeriodicBox const box{{-1, -1, 0}, {1, 1, 2}};
    WallSettings outlet = plane({0, 0, 0}, {0, 0, 1}, "outlet");
    HoleSettings hole;
    hole.name = "hole";
    hole.diameter = 0.5;
    outlet.holes = {hole};
    Walls walls = in_the_box({outlet}, box);
    WallAction open;
    open.wall = "outlet";
    open.open = {"hole"};
    begin_stage(walls, {open});
    // In the hole and outside the domain; beside the hole, outside; in the hole, still inside; through a side.
    Particles const particles = make_particles(
        {grain({0.1, 0, -0.01}, 0.2), grain({0.6, 0, -0.01}, 0.2), grain({0, 0, 0.01}, 0.2), grain({1.01, 0, 1}, 0.2)},
        {2605});
    Departures const departures = find_departures(particles, box, walls, 0);
    ASSERT_EQ(departures.produced.size(), 1u);
    EXPECT_EQ(departures.produced[0].id, 0);
    ASSERT_EQ(departures.lost.size(), 2u);
    EXPECT_EQ(departures.lost[0].id, 1);
    EXPECT_EQ(departures.lost[1].id, 3);
    EXPECT_TRUE(find_departures(particles, box, walls, -1).produced.empty());
}

} // namespace
} // namespace arenite
