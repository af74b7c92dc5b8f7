// SPDX-License-Identifier: MIT
// How far walls came, and their state to and from a checkpoint.
#include "core/error.hpp"
#include "core/wall_geometry.hpp"
#include "core/wall_motion.hpp"

#include <algorithm>
#include <cmath>

namespace arenite {

Real surface_motion(Walls const& walls, int wall, std::function<Vec3(Vec3 const&)> const& moved,
                    std::function<Vec3(Vec3 const&)> const& turned)
{
    WallBody const& body = walls.body[wall];
    Real const tilt = norm(turned(body.axis));
    auto const corners = [&](Vec3 const& lower, Vec3 const& upper) {
        Real most = 0; // a point of a box moves no farther than its corners
        for (int corner = 0; corner < 8; ++corner)
            most = std::max(most, norm(moved({corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y,
                                              corner & 4 ? upper.z : lower.z})));
        return most;
    };
    switch (body.shape) {
    case WallShape::plane: {
        Vec3 const shift = moved({});
        if (body.holes > 0) return norm(shift) + tilt * norm(walls.upper - walls.lower);
        Vec3 const normal = body.pose.direction_to_world(body.axis);
        return std::fabs(dot(shift, normal)) + tilt * norm(walls.upper - walls.lower) + norm(shift) * tilt;
    }
    case WallShape::cylinder:
        return std::max(norm(moved({})), norm(moved(body.length * body.axis))) + tilt * body.radius;
    case WallShape::box:
        return corners(-body.half, body.half);
    case WallShape::mesh:
        return corners(walls.mesh_part[wall].lower, walls.mesh_part[wall].upper);
    }
    return 0;
}

bool stands_clear(Walls const& walls, Vec3 const& x, Real radius)
{
    Real const least = radius * (1 - Real(1e-9)); // what a rounding takes from a grain that was put against a wall
    auto const is_clear = [&](int w) {
        WallBody const& body = walls.body[w];
        Vec3 const local = pose_of(walls.state[w]).to_local(x);
        switch (body.shape) {
        case WallShape::plane:
            return dot(body.axis, local) >= least;
        case WallShape::cylinder: {
            if (!body.inside) return wall_geometry::rod(body.axis, body.length, body.radius, local).distance >= least;
            wall_geometry::AxialPosition const p = wall_geometry::axial_position(local, body.axis);
            bool const beyond_its_ends = p.height < -radius || p.height > body.length + radius;
            return beyond_its_ends || body.radius - p.radial >= least;
        }
        case WallShape::box:
            if (!body.inside) return wall_geometry::solid_box(body.half, local).distance >= least;
            for (int axis = 0; axis < 3; ++axis)
                if (body.half[axis] - std::fabs(local[axis]) < least) return false;
            return true;
        case WallShape::mesh:
            return true;
        }
        return true;
    };
    for (int w = 0; w < walls.count(); ++w)
        if (walls.state[w].present && !is_clear(w)) return false;
    return true;
}

Real wall_displacement(Walls const& walls, std::vector<WallPose> const& before)
{
    Real most = 0;
    for (int w = 0; w < walls.count() && w < static_cast<int>(before.size()); ++w) {
        if (!walls.state[w].present) continue;
        WallPose const now = pose_of(walls.state[w]);
        WallPose const& then = before[w];
        most = std::max(most, surface_motion(
                                  walls, w, [&](Vec3 const& x) { return now.to_world(x) - then.to_world(x); },
                                  [&](Vec3 const& d) { return now.direction_to_world(d) - then.direction_to_world(d); }));
    }
    return most;
}

namespace {

/// Calls number(x) for every number of a wall's state, in a fixed order; writing and reading are the same list.
template <class State, class Number> void for_each_number(State& s, Number const& number)
{
    auto const vector = [&](auto& v) { number(v.x), number(v.y), number(v.z); };
    auto const turn = [&](auto& q) {
        for (auto& component : q) number(component);
    };
    number(s.present), number(s.two_sided);
    vector(s.position), turn(s.orientation), vector(s.velocity), vector(s.angular_velocity);
    auto& p = s.program;
    vector(p.start_position), turn(p.start_orientation), vector(p.velocity), vector(p.angular_velocity);
    number(p.ramp_time), number(p.travel), number(p.and_back), number(p.earlier), number(p.dt), number(p.steps),
        number(p.done);
    auto& servo = s.servo;
    number(servo.on), number(servo.target), vector(servo.axis), number(servo.max_speed), number(servo.speed),
        number(servo.steps);
}

} // namespace

std::map<std::string, std::vector<Real>> save_walls(Walls const& walls)
{
    std::map<std::string, std::vector<Real>> arrays{{"state", {}}, {"holes", {}}};
    for (WallState const& state : walls.state) {
        for_each_number(state, [&](auto const& x) { arrays["state"].push_back(static_cast<Real>(x)); });
        for (std::uint8_t open : state.hole_open) arrays["holes"].push_back(open);
    }
    return arrays;
}

void restore_walls(Walls& walls, std::map<std::string, std::vector<Real>> const& arrays)
{
    std::vector<Real> const &numbers = arrays.at("state"), &holes = arrays.at("holes");
    std::size_t n = 0, h = 0, needed = 0, needed_holes = 0;
    for (WallState& state : walls.state) {
        for_each_number(state, [&](auto&) { ++needed; });
        needed_holes += state.hole_open.size();
    }
    if (numbers.size() != needed || holes.size() != needed_holes)
        throw InputError("checkpoint: its walls are not those of the scene");
    for (WallState& state : walls.state) {
        for_each_number(state, [&](auto& x) { x = static_cast<std::remove_reference_t<decltype(x)>>(numbers[n++]); });
        for (std::uint8_t& open : state.hole_open) open = static_cast<std::uint8_t>(holes[h++]);
    }
    upload_bodies(walls);
}

} // namespace arenite
