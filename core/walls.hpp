// SPDX-License-Identifier: MIT
// Walls: what they are (from the scene), where they are and how they move. The host decides the motion, in
// double precision and from step counts, so that a travel ends where it should; kernels see a compact
// record per wall, refreshed by a launch that carries the new poses in its arguments (no copy, no wait).
#pragma once

#include "core/mesh_geometry.hpp"
#include "core/scene.hpp"

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace arenite {

/// A wall as kernels see it. Elements number the surfaces that can each touch a grain once: 1 for a plane, a
/// cylinder, a solid box; 6 for the inside of a box; the triangles of a mesh.
struct WallBody {
    WallShape shape = WallShape::plane;
    bool inside = false, present = true;
    bool two_sided = false; // a plate whose holes have been open
    std::uint8_t material = 0;
    int first_element = 0, elements = 1; // numbered through all walls
    int first_hole = 0, holes = 0;       // open ones, in WallViews::hole
    Vec3 axis;                           // own frame: a plane's normal, a cylinder's direction; unit
    Real length = 0, radius = 0;         // cylinder, m
    Vec3 half;                           // box, m
    int first_triangle = 0;
    MeshGrid grid;
    WallPose pose;
};

struct WallViews {
    View1<WallBody> body;       // [wall]
    View1<OpenHole> hole;       // open holes of all walls
    View1<int> wall_of_element; // [element]
    MeshViews mesh;
};

using Quaternion = std::array<Real, 4>; // w, x, y, z

/// Prescribed motion since the stage began: speed factor up in ramp_time, on, down; back again if asked.
struct WallProgram {
    Vec3 start_position;
    Quaternion start_orientation{1, 0, 0, 0};
    Vec3 velocity, angular_velocity; // at full speed
    Real ramp_time = 0;              // s
    Real travel = 0;                 // m, 0: without end
    bool and_back = false;
    Real earlier = 0;    // s of the program made under other time steps
    Real dt = 0;         // s
    long long steps = 0; // made with dt
    bool done = true;    // the travel is made, or there is none
};

/// A servo's state; see update_servos.
struct WallServo {
    bool on = false;
    Real target = 0; // N, compression positive
    Vec3 axis;
    Real max_speed = 0; // m/s
    Real speed = 0;     // m/s along axis, now
    long long steps = 0;
};

/// All that changes about a wall: plain data, in checkpoints as it is.
struct WallState {
    bool present = true;
    bool two_sided = false;
    Vec3 position; // of the reference point: point, base, box centre or mesh offset
    Quaternion orientation{1, 0, 0, 0};
    Vec3 velocity, angular_velocity;
    WallProgram program;
    WallServo servo;
    std::vector<std::uint8_t> hole_open; // [hole of the settings]
};

struct Walls {
    std::vector<WallSettings> settings; // [wall] as the scene gave them
    std::vector<WallState> state;       // [wall]
    std::vector<WallBody> body;         // [wall] what the device has
    std::vector<MeshPart> mesh_part;    // [wall]
    Vec3 lower, upper;                  // the domain as it is now: reach of infinite planes, default area of servos
    WallViews views;

    int count() const { return static_cast<int>(settings.size()); }
    int elements() const { return body.empty() ? 0 : body.back().first_element + body.back().elements; }
    /// Row of a wall by name; throws InputError if there is none.
    int find(std::string const& name) const;
};

struct WallContext {
    std::vector<std::string> materials;                  // names in row order
    Vec3 lower, upper;                                   // domain, m
    std::map<std::string, std::vector<Triangle>> meshes; // by wall name, as read from the file, unscaled
};

/// Checks the settings and builds the walls at their places, at rest, holes closed. Throws InputError that lists
/// every fault.
Walls make_walls(std::vector<WallSettings> const& settings, WallContext const& context);

/// All walls stop; then those that the stage names get their presence, holes, motion or servo. Search the wall
/// contacts anew after it. Throws InputError for unknown names and contradictory actions.
void begin_stage(Walls& walls, std::vector<WallAction> const& actions);

/// Sends the walls' state to the device: the poses only (a launch), or everything after a change of presence or holes.
void upload_poses(Walls& walls);
void upload_bodies(Walls& walls);

WallPose pose_of(WallState const& state);

/// Point of a plane's or cylinder's axis direction in the world, now.
Vec3 axis_of(Walls const& walls, int wall);

/// Whether a sphere stands wholly on the grains' side of every present wall. Meshes are not looked at.
bool stands_clear(Walls const& walls, Vec3 const& x, Real radius);

/// Upper bound of how far any point of the present walls' surfaces came towards grains since `before` [m].
/// Sliding in their own surface (a plate sideways, a cylinder about its axis) brings them no nearer.
Real wall_displacement(Walls const& walls, std::vector<WallPose> const& before);

/// The same bound for any motion: moved(x) is how far (or fast) the point x of the wall's frame moves, turned(d) how a
/// direction d of it changes.
Real surface_motion(Walls const& walls, int wall, std::function<Vec3(Vec3 const&)> const& moved,
                    std::function<Vec3(Vec3 const&)> const& turned);

/// The state as flat named arrays of numbers, and back. Restoring checks that the walls are as many.
std::map<std::string, std::vector<Real>> save_walls(Walls const& walls);
void restore_walls(Walls& walls, std::map<std::string, std::vector<Real>> const& arrays);

/// An element whose side and normal are the same for every grain. In the world's frame.
struct FlatFace {
    Vec3 normal;    // unit, towards the grains
    Real level = 0; // m: a point x is at the distance level + dot(normal, x - pose.position)
};

/// Whether all elements of the wall are flat faces: a plane that had no open holes, the inside of a box.
KOKKOS_FUNCTION inline bool has_flat_faces(WallBody const& body)
{
    return body.shape == WallShape::plane ? !body.two_sided : body.shape == WallShape::box && body.inside;
}

/// Element of such a wall. Those of a box: x lower, x upper, y lower, ...
KOKKOS_FUNCTION inline FlatFace flat_face(WallBody const& body, int element)
{
    if (body.shape == WallShape::plane) return {body.pose.direction_to_world(body.axis), 0};
    int const face = element - body.first_element, axis = face / 2;
    Vec3 normal;
    normal[axis] = face % 2 == 0 ? Real(1) : Real(-1);
    return {body.pose.direction_to_world(normal), body.half[axis]};
}

/// Nearest point of an element to a world point. side: see wall_geometry.hpp. The normal is in the world's frame.
KOKKOS_FUNCTION inline WallProximity wall_proximity(WallViews const& views, WallBody const& body, int element, Vec3 const& x,
                                                    Real grain_radius, Real& side)
{
    if (has_flat_faces(body)) {
        FlatFace const face = flat_face(body, element);
        return {face.normal, face.level + dot(face.normal, x - body.pose.position), true};
    }
    Vec3 const local = body.pose.to_local(x);
    WallProximity p;
    switch (body.shape) {
    case WallShape::plane:
        p = wall_geometry::plate(body.axis, views.hole, body.first_hole, body.holes, local, grain_radius, side);
        break;
    case WallShape::cylinder:
        p = body.inside ? wall_geometry::tube(body.axis, body.length, body.radius, local, grain_radius, side)
                        : wall_geometry::rod(body.axis, body.length, body.radius, local);
        break;
    case WallShape::box:
        p = wall_geometry::solid_box(body.half, local);
        break;
    case WallShape::mesh:
        p = wall_geometry::mesh_triangle(views.mesh, body.first_triangle + element - body.first_element, local, grain_radius,
                                         side);
        break;
    }
    p.normal = body.pose.direction_to_world(p.normal);
    return p;
}

} // namespace arenite
