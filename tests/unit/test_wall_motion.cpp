// SPDX-License-Identifier: MIT
#include "core/error.hpp"
#include "core/wall_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace arenite {
namespace {

WallSettings wall_named(std::string const& name, WallShape shape)
{
    WallSettings wall;
    wall.name = name;
    wall.shape = shape;
    wall.material = "steel";
    wall.axis = {0, 0, -0.01};
    wall.base = {0, 0, 0.02};
    wall.diameter = 0.0017;
    wall.box = {{0, 0, 0}, {1, 1, 1}};
    return wall;
}

Walls make(std::vector<WallSettings> const& settings) { return make_walls(settings, {{"steel"}, {0, 0, 0}, {1, 2, 3}, {}}); }

std::string message_of(std::vector<WallSettings> const& settings)
{
    try {
        make(settings);
    } catch (InputError const& error) {
        return error.what();
    }
    return "";
}

TEST(WallMotion, ProgramIsTheIntegralOfItsFactor)
{
    for (Real ramp : {0.0, 0.2, 3.0})
        for (Real travel : {0.0, 1.0, 2.0})
            for (bool back : {false, true}) {
                Real const dt = 1e-3;
                Real sum = 0;
                for (int n = 0; n < 9000; ++n) {
                    sum += dt * program_at((n + 0.5) * dt, ramp, travel, back).factor;
                    Real const end = (n + 1) * dt;
                    ASSERT_NEAR(program_at(end, ramp, travel, back).integral, sum, 2 * dt) << end;
                }
                if (travel == 0) continue;
                ProgramPoint const last = program_at(9.01, ramp, travel, back);
                if (last.done) {
                    EXPECT_EQ(last.integral, back ? 0 : travel); // exactly
                }
            }
}

TEST(WallMotion, TravelThereAndBackEndsExactly)
{
    Walls walls = make({wall_named("rod", WallShape::cylinder)});
    WallAction action;
    action.wall = "rod";
    action.velocity = Vec3{0, 0, -0.3};
    action.travel = 0.0107;
    action.and_back = true;
    action.ramp_time = 1e-3;
    begin_stage(walls, {action});
    Real lowest = 1;
    int steps = 0;
    while (!walls.state[0].program.done && steps < 1000000) {
        move_walls(walls, steps < 2000 ? 1e-5 : 1.7e-5); // the step may change on the way
        lowest = std::min(lowest, walls.state[0].position.z);
        ++steps;
    }
    EXPECT_NEAR(lowest, 0.02 - 0.0107, 1e-8);
    EXPECT_EQ(walls.state[0].position, (Vec3{0, 0, 0.02}));
    EXPECT_EQ(walls.state[0].velocity, (Vec3{}));
    EXPECT_FALSE(any_wall_moves(walls));
}

TEST(WallMotion, RampedMotionWithoutEndStartsAndTurns)
{
    Walls walls = make({wall_named("rod", WallShape::cylinder)});
    WallAction action;
    action.wall = "rod";
    action.angular_velocity = Vec3{0, 2, 0};
    action.ramp_time = 0.1;
    begin_stage(walls, {action});
    for (int n = 0; n < 1000; ++n) move_walls(walls, 1e-3);
    Real const angle = 2 * (1 - 0.05); // rad
    Vec3 const axis = axis_of(walls, 0);
    EXPECT_NEAR(axis.x, -std::sin(angle), 1e-12);
    EXPECT_NEAR(axis.z, -std::cos(angle), 1e-12);
    auto const device = Kokkos::create_mirror_view_and_copy(HostSpace(), walls.views.body);
    EXPECT_EQ(device(0).pose.rotation[2], walls.body[0].pose.rotation[2]);
    EXPECT_DOUBLE_EQ(device(0).pose.angular_velocity.y, 2);
}

TEST(WallMotion, DisplacementKnowsWhatSlidingDoesNotDo)
{
    WallSettings plate = wall_named("plate", WallShape::plane);
    Walls walls = make({plate, wall_named("rod", WallShape::cylinder)});
    std::vector<WallPose> const before{pose_of(walls.state[0]), pose_of(walls.state[1])};
    WallAction slide, spin;
    slide.wall = "plate";
    slide.velocity = Vec3{1, 0, 0};
    spin.wall = "rod";
    spin.angular_velocity = Vec3{0, 0, 100};
    begin_stage(walls, {slide, spin});
    for (int n = 0; n < 10; ++n) move_walls(walls, 1e-3);
    EXPECT_NEAR(wall_displacement(walls, before), 0, 1e-15);
    EXPECT_EQ(tunnelling_walls(walls, 1e-4, 1e-3), "");
    slide.velocity = Vec3{1, 0, 1};
    begin_stage(walls, {slide});
    for (int n = 0; n < 10; ++n) move_walls(walls, 1e-3);
    EXPECT_NEAR(wall_displacement(walls, before), 0.01, 1e-15);
    EXPECT_EQ(tunnelling_walls(walls, 1e-4, 0.9e-5), "");
    EXPECT_NE(tunnelling_walls(walls, 1e-4, 1.1e-5).find("wall plate moves 1.1e-05 m"), std::string::npos);
}

TEST(WallMotion, StateSurvivesSavingToTheBit)
{
    WallSettings plate = wall_named("plate", WallShape::plane);
    plate.holes = {{"hole", {0.1, 0.2, 0}, 0.05}};
    WallAction turn, servo;
    turn.wall = "rod";
    turn.velocity = Vec3{0.1, 0, 0.3};
    turn.angular_velocity = Vec3{1, 2, 3};
    turn.travel = 0.5;
    servo.wall = "plate";
    servo.servo = ServoSettings{1e6, 0, 0, {0, 0, -1}, 0.1};
    servo.open = {"hole"};
    Walls a = make({plate, wall_named("rod", WallShape::cylinder)}), b = a;
    b.views = make({plate, wall_named("rod", WallShape::cylinder)}).views;
    begin_stage(a, {turn, servo});
    EXPECT_DOUBLE_EQ(a.state[0].servo.target, 2e6); // 1 MPa on 1 m x 2 m
    std::vector<WallReaction> const reactions(2);
    for (int n = 0; n < 101; ++n) {
        move_walls(a, 1e-3);
        if (servo_is_due(a)) update_servos(a, reactions, 1e-3);
    }
    restore_walls(b, save_walls(a));
    for (Walls* walls : {&a, &b})
        for (int n = 0; n < 37; ++n) {
            move_walls(*walls, 1e-3);
            if (servo_is_due(*walls)) update_servos(*walls, reactions, 1e-3);
        }
    EXPECT_EQ(save_walls(a), save_walls(b));
    EXPECT_EQ(b.state[0].hole_open[0], 1);
    EXPECT_EQ(b.body[0].holes, 1);
    EXPECT_THROW(restore_walls(b, {{"state", {1, 2}}, {"holes", {0}}}), InputError);
}

TEST(WallMotion, WrongSettingsAreListedTogether)
{
    WallSettings rod = wall_named("rod", WallShape::cylinder), plate = wall_named("plate", WallShape::plane);
    rod.diameter = -1;
    plate.material = "stel";
    plate.holes = {{"a", {0, 0, 0}, 0.1}, {"b", {0.05, 0, 0}, 0.1}};
    EXPECT_EQ(message_of({rod, plate}), "walls: rod: the diameter must be positive\n"
                                        "walls: plate: there is no material 'stel'\n"
                                        "walls: plate: hole b overlaps hole a");
    Walls walls = make({wall_named("rod", WallShape::cylinder)});
    WallAction action;
    action.wall = "rot";
    EXPECT_THROW(begin_stage(walls, {action}), InputError);
    action.wall = "rod";
    action.travel = 1;
    EXPECT_THROW(begin_stage(walls, {action}), InputError);
    action.travel.reset();
    action.open = {"hole"};
    EXPECT_THROW(begin_stage(walls, {action}), InputError);
}

} // namespace
} // namespace arenite
