// SPDX-License-Identifier: MIT
#include "core/wall_motion.hpp"

#include "core/error.hpp"
#include "core/periodic_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace arenite {
namespace {

/// One way of a travel: up in ramp, on, down; the area under the factor is travel_time.
ProgramPoint one_way(Real time, Real ramp, Real travel_time)
{
    Real peak = 1;
    if (ramp > travel_time) { // full speed is not reached: the same acceleration, a lower peak
        peak = std::sqrt(travel_time / ramp);
        ramp *= peak;
    }
    Real const end = travel_time / peak + ramp;
    if (time >= end) return {0, travel_time, true};
    if (time < ramp) return {peak * time / ramp, peak * time * time / (2 * ramp), false};
    if (time <= end - ramp) return {peak, peak * (time - ramp / 2), false};
    Real const left = end - time;
    return {peak * left / ramp, travel_time - peak * left * left / (2 * ramp), false};
}

Real one_way_duration(Real ramp, Real travel_time)
{
    return ramp > travel_time ? 2 * std::sqrt(travel_time * ramp) : travel_time + ramp;
}

Quaternion product(Quaternion const& a, Quaternion const& b)
{
    return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

Quaternion turn_about(Vec3 const& rotation) // rad
{
    Real const angle = norm(rotation);
    if (!(angle > 0)) return {1, 0, 0, 0};
    Vec3 const axis = std::sin(angle / 2) / angle * rotation;
    return {std::cos(angle / 2), axis.x, axis.y, axis.z};
}

void follow_program(WallState& state, Real dt)
{
    WallProgram& program = state.program;
    if (program.dt != dt) {
        program.earlier += static_cast<Real>(program.steps) * program.dt;
        program.steps = 0;
        program.dt = dt;
    }
    ++program.steps;
    Real const travel_time = program.travel > 0 ? program.travel / norm(program.velocity) : 0;
    Real const time = program.earlier + static_cast<Real>(program.steps) * dt;
    ProgramPoint const point = program_at(time, program.ramp_time, travel_time, program.and_back);
    state.position = program.start_position + point.integral * program.velocity;
    state.velocity = point.factor * program.velocity;
    state.angular_velocity = point.factor * program.angular_velocity;
    if (!(program.angular_velocity == Vec3{}))
        state.orientation = product(turn_about(point.integral * program.angular_velocity), program.start_orientation);
    program.done = point.done;
}

bool moves(WallState const& state)
{
    WallProgram const& p = state.program;
    bool const on_its_way = !(p.velocity == Vec3{}) || !(p.angular_velocity == Vec3{});
    bool const rests = p.travel > 0 && p.done && state.velocity == Vec3{} && state.angular_velocity == Vec3{};
    return state.servo.on || (on_its_way && !rests);
}

void set_servo(Walls const& walls, WallState& state, ServoSettings const& settings)
{
    state.servo.on = true;
    state.servo.axis = normalized(settings.axis);
    Real const area = settings.area > 0 ? settings.area : cross_section(walls.upper - walls.lower, state.servo.axis);
    state.servo.target = settings.force > 0 ? settings.force : settings.stress * area;
    state.servo.max_speed = settings.max_speed;
}

std::string check_action(Walls const& walls, WallAction const& action)
{
    std::string faults;
    auto const fault = [&](std::string const& text) { faults += fmt::format("walls: {}: {}\n", action.wall, text); };
    if (std::none_of(walls.settings.begin(), walls.settings.end(), [&](auto const& w) { return w.name == action.wall; })) {
        fault("there is no such wall");
        return faults;
    }
    WallSettings const& wall = walls.settings[walls.find(action.wall)];
    for (auto const& names : {action.open, action.close})
        for (std::string const& name : names)
            if (std::none_of(wall.holes.begin(), wall.holes.end(), [&](auto const& h) { return h.name == name; }))
                fault("it has no hole '" + name + "'");
    bool const driven = action.velocity || action.angular_velocity;
    if (action.servo && driven) fault("it cannot be moved and servo-controlled at once");
    if (action.servo && !(norm(action.servo->axis) > 0)) fault("the servo's axis has no length");
    if (action.servo && !(action.servo->max_speed > 0)) fault("the servo's max_speed must be positive");
    if (action.travel && !(action.velocity && norm(*action.velocity) > 0)) fault("a travel needs a velocity");
    if (action.travel && !(*action.travel > 0)) fault("the travel must be positive");
    if (action.and_back && !action.travel) fault("and_back needs a travel");
    if (action.ramp_time && !(*action.ramp_time >= 0)) fault("the ramp time must not be negative");
    return faults;
}

void start_action(Walls& walls, WallAction const& action)
{
    int const w = walls.find(action.wall);
    WallState& state = walls.state[w];
    if (action.present) state.present = *action.present;
    auto const set_holes = [&](std::vector<std::string> const& names, std::uint8_t open) {
        for (std::size_t h = 0; h < state.hole_open.size(); ++h)
            if (std::find(names.begin(), names.end(), walls.settings[w].holes[h].name) != names.end())
                state.hole_open[h] = open;
        if (open && !names.empty()) state.two_sided = true;
    };
    set_holes(action.open, 1);
    set_holes(action.close, 0);
    if (action.servo) set_servo(walls, state, *action.servo);
    WallProgram& program = state.program;
    program.velocity = action.velocity.value_or(Vec3{});
    program.angular_velocity = action.angular_velocity.value_or(Vec3{});
    program.ramp_time = action.ramp_time.value_or(0);
    program.travel = action.travel.value_or(0);
    program.and_back = action.and_back;
    program.done = !action.travel;
    if (program.ramp_time == 0) { // at speed from the first moment
        state.velocity = program.velocity;
        state.angular_velocity = program.angular_velocity;
    }
}

} // namespace

ProgramPoint program_at(Real time, Real ramp_time, Real travel_time, bool and_back)
{
    if (!(travel_time > 0)) {
        if (time < ramp_time) return {time / ramp_time, time * time / (2 * ramp_time), true};
        return {1, time - ramp_time / 2, true};
    }
    Real const turning = one_way_duration(ramp_time, travel_time);
    if (!and_back || time < turning) {
        ProgramPoint point = one_way(time, ramp_time, travel_time);
        point.done = point.done && !and_back;
        return point;
    }
    ProgramPoint const back = one_way(time - turning, ramp_time, travel_time);
    return {-back.factor, travel_time - back.integral, back.done};
}

Real program_duration(Real ramp_time, Real travel_time, bool and_back)
{
    return (and_back ? 2 : 1) * one_way_duration(ramp_time, travel_time);
}

void begin_stage(Walls& walls, std::vector<WallAction> const& actions)
{
    std::string faults;
    for (WallAction const& action : actions) faults += check_action(walls, action);
    if (!faults.empty()) throw InputError(faults.substr(0, faults.size() - 1));
    for (WallState& state : walls.state) {
        state.velocity = state.angular_velocity = {};
        state.program = {};
        state.program.start_position = state.position;
        state.program.start_orientation = state.orientation;
        state.servo = {};
    }
    for (WallAction const& action : actions) start_action(walls, action);
    upload_bodies(walls);
}

bool any_wall_moves(Walls const& walls) { return std::any_of(walls.state.begin(), walls.state.end(), moves); }

void move_walls(Walls& walls, Real dt)
{
    if (!any_wall_moves(walls)) return;
    for (WallState& state : walls.state) {
        if (!moves(state)) continue;
        if (state.servo.on) {
            state.velocity = state.servo.speed * state.servo.axis;
            state.position += dt * state.velocity;
            ++state.servo.steps;
        } else follow_program(state, dt);
    }
    upload_poses(walls);
}

bool servo_is_due(Walls const& walls)
{
    return std::any_of(walls.state.begin(), walls.state.end(),
                       [](WallState const& s) { return s.servo.on && s.servo.steps % servo_interval == 0; });
}

void update_servos(Walls& walls, std::vector<WallReaction> const& reactions, Real dt)
{
    for (int w = 0; w < walls.count(); ++w) {
        WallServo& servo = walls.state[w].servo;
        if (!servo.on) continue;
        Real const force = -dot(reactions[w].force, servo.axis);
        Real const impedance = std::max(reactions[w].impedance, 2 * reactions[w].stiffness * servo_interval * dt);
        Real const aim = impedance > 0 ? (servo.target - force) / impedance : servo.max_speed;
        Real const bounded = std::clamp(aim, -servo.max_speed, servo.max_speed);
        servo.speed += Real(0.25) * (bounded - servo.speed);
    }
}

std::string tunnelling_walls(Walls const& walls, Real smallest_radius, Real dt)
{
    std::string message;
    for (int w = 0; w < walls.count(); ++w) {
        WallState const& state = walls.state[w];
        if (!state.present) continue;
        Vec3 velocity = state.program.velocity;
        if (state.servo.on) velocity = state.servo.max_speed * state.servo.axis;
        WallPose const pose = pose_of(state);
        Vec3 const omega = state.program.angular_velocity;
        Real const speed = surface_motion(
            walls, w, [&](Vec3 const& x) { return velocity + cross(omega, pose.direction_to_world(x)); },
            [&](Vec3 const& d) { return cross(omega, pose.direction_to_world(d)); });
        if (speed * dt < Real(0.1) * smallest_radius) continue;
        message +=
            fmt::format("wall {} moves {:.3g} m in a step of {:.3g} s ({:.3g} m/s), more than a tenth of the smallest "
                        "grain's radius ({:.3g} m): it could pass through grains\n",
                        walls.settings[w].name, speed * dt, dt, speed, smallest_radius);
    }
    return message;
}

} // namespace arenite
