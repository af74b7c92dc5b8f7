// SPDX-License-Identifier: MIT
#include "core/walls.hpp"

#include "core/error.hpp"
#include "core/to_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace arenite {
namespace {

std::string check_hole(WallSettings const& wall, std::size_t h)
{
    HoleSettings const& hole = wall.holes[h];
    std::string const name = fmt::format("walls: {}: hole {}", wall.name, hole.name);
    if (!(hole.diameter > 0)) return fmt::format("{}: the diameter is {} m, it must be positive\n", name, hole.diameter);
    if (wall.shape != WallShape::plane) return name + ": only a plane has holes\n";
    Vec3 const normal = normalized(wall.normal);
    for (std::size_t k = 0; k < h; ++k) {
        Vec3 const d = hole.center - wall.holes[k].center;
        if (norm(d - dot(d, normal) * normal) < (hole.diameter + wall.holes[k].diameter) / 2)
            return fmt::format("{} overlaps hole {}\n", name, wall.holes[k].name);
    }
    return "";
}

std::string check_wall(WallSettings const& wall, WallContext const& context)
{
    std::string faults;
    auto const fault = [&](std::string const& text) { faults += fmt::format("walls: {}: {}\n", wall.name, text); };
    if (std::find(context.materials.begin(), context.materials.end(), wall.material) == context.materials.end())
        fault("there is no material '" + wall.material + "'");
    if (wall.shape == WallShape::plane && !(norm(wall.normal) > 0)) fault("the normal has no length");
    if (wall.shape == WallShape::cylinder && !(norm(wall.axis) > 0)) fault("the axis has no length");
    if (wall.shape == WallShape::cylinder && !(wall.diameter > 0)) fault("the diameter must be positive");
    if (wall.shape == WallShape::box)
        for (int axis = 0; axis < 3; ++axis)
            if (!(wall.box.upper[axis] > wall.box.lower[axis])) fault("the box's upper corner must lie above the lower one");
    if (wall.shape == WallShape::mesh && !context.meshes.contains(wall.name)) fault("its mesh was not read");
    if (wall.shape == WallShape::mesh && !(wall.scale > 0)) fault("the scale must be positive");
    if (wall.shape == WallShape::plane && !(norm(wall.normal) > 0)) return faults;
    for (std::size_t h = 0; h < wall.holes.size(); ++h) faults += check_hole(wall, h);
    return faults;
}

/// The reference point and, in the frame at rest around it, the shape.
Vec3 set_shape(WallSettings const& wall, WallBody& body)
{
    body.shape = wall.shape;
    body.inside = wall.inside;
    switch (wall.shape) {
    case WallShape::plane:
        body.axis = normalized(wall.normal);
        return wall.point;
    case WallShape::cylinder:
        body.length = norm(wall.axis);
        body.axis = wall.axis / body.length;
        body.radius = wall.diameter / 2;
        return wall.base;
    case WallShape::box:
        body.half = Real(0.5) * (wall.box.upper - wall.box.lower);
        body.elements = wall.inside ? 6 : 1;
        return Real(0.5) * (wall.box.upper + wall.box.lower);
    case WallShape::mesh:
        break;
    }
    return wall.offset;
}

std::vector<Triangle> scaled(std::vector<Triangle> triangles, Real scale)
{
    for (Triangle& t : triangles)
        for (Vec3& corner : t.corner) corner *= scale;
    return triangles;
}

} // namespace

int Walls::find(std::string const& name) const
{
    for (int w = 0; w < count(); ++w)
        if (settings[w].name == name) return w;
    throw InputError("there is no wall '" + name + "'");
}

Walls make_walls(std::vector<WallSettings> const& settings, WallContext const& context)
{
    std::string faults;
    for (WallSettings const& wall : settings) faults += check_wall(wall, context);
    if (settings.size() > 256) faults += "walls: there are more than 256\n";
    if (!faults.empty()) throw InputError(faults.substr(0, faults.size() - 1));
    Walls walls;
    walls.settings = settings;
    walls.lower = context.lower;
    walls.upper = context.upper;
    MeshData mesh;
    for (WallSettings const& wall : settings) {
        WallBody body;
        WallState state;
        MeshPart part;
        state.position = set_shape(wall, body);
        state.present = wall.present;
        state.program.start_position = state.position;
        state.hole_open.assign(wall.holes.size(), 0);
        auto const material = std::find(context.materials.begin(), context.materials.end(), wall.material);
        body.material = static_cast<std::uint8_t>(material - context.materials.begin());
        if (wall.shape == WallShape::mesh) {
            part = append_mesh(mesh, scaled(context.meshes.at(wall.name), wall.scale), "walls: " + wall.name);
            body.elements = part.triangles;
            body.first_triangle = part.first_triangle;
            body.grid = part.grid;
        }
        body.first_element = walls.elements();
        walls.body.push_back(body);
        walls.state.push_back(state);
        walls.mesh_part.push_back(part);
    }
    walls.views.mesh = upload(mesh);
    std::vector<int> wall_of_element;
    for (int w = 0; w < walls.count(); ++w) wall_of_element.insert(wall_of_element.end(), walls.body[w].elements, w);
    walls.views.wall_of_element = to_device(wall_of_element, "wall_of_element");
    upload_bodies(walls);
    return walls;
}

WallPose pose_of(WallState const& state)
{
    auto const [w, x, y, z] = state.orientation;
    WallPose pose;
    pose.position = state.position;
    pose.velocity = state.velocity;
    pose.angular_velocity = state.angular_velocity;
    Real const rotation[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                              2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                              2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
    std::copy(rotation, rotation + 9, pose.rotation);
    return pose;
}

void upload_bodies(Walls& walls)
{
    std::vector<OpenHole> holes;
    for (int w = 0; w < walls.count(); ++w) {
        WallState const& state = walls.state[w];
        WallBody& body = walls.body[w];
        body.present = state.present;
        body.two_sided = state.two_sided;
        body.pose = pose_of(state);
        body.first_hole = static_cast<int>(holes.size());
        for (std::size_t h = 0; h < state.hole_open.size(); ++h) {
            if (!state.hole_open[h]) continue;
            HoleSettings const& hole = walls.settings[w].holes[h];
            Vec3 const offset = hole.center - walls.settings[w].point;
            holes.push_back({offset - dot(offset, body.axis) * body.axis, hole.diameter / 2});
        }
        body.holes = static_cast<int>(holes.size()) - body.first_hole;
    }
    walls.views.hole = to_device(holes, "wall_holes");
    walls.views.body = to_device(walls.body, "wall_bodies");
}

void upload_poses(Walls& walls)
{
    constexpr int most = 8; // poses a launch: 1.3 kB of kernel arguments
    for (int first = 0; first < walls.count(); first += most) {
        Kokkos::Array<WallPose, most> poses;
        int const last = std::min(first + most, walls.count());
        for (int w = first; w < last; ++w) poses[w - first] = walls.body[w].pose = pose_of(walls.state[w]);
        View1<WallBody> const body = walls.views.body;
        Kokkos::parallel_for(
            "upload_poses", RangePolicy(first, last), KOKKOS_LAMBDA(int w) { body(w).pose = poses[w - first]; });
    }
}

Vec3 axis_of(Walls const& walls, int wall) { return walls.body[wall].pose.direction_to_world(walls.body[wall].axis); }

} // namespace arenite
