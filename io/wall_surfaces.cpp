// SPDX-License-Identifier: MIT
#include "io/wall_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace arenite {
namespace {

constexpr int circle_corners = 48;
constexpr Real two_pi = 2 * std::numbers::pi_v<Real>;

using Polygon = std::vector<Vec3>;

class Surface {
public:
    explicit Surface(Real time)
    {
        piece_.time = time;
        piece_.kind = CellKind::polygons;
    }
    void add(int wall, Polygon const& polygon)
    {
        if (polygon.size() < 3) return;
        for (Vec3 const& corner : polygon) {
            piece_.connectivity.push_back(static_cast<std::int64_t>(piece_.point_count()));
            piece_.points.insert(piece_.points.end(), {corner.x, corner.y, corner.z});
        }
        piece_.offsets.push_back(static_cast<std::int64_t>(piece_.connectivity.size()));
        wall_.push_back(wall);
    }
    PolyPiece finish()
    {
        piece_.cell_data.push_back({"wall", 1, std::move(wall_)});
        return std::move(piece_);
    }

private:
    PolyPiece piece_;
    std::vector<int> wall_;
};

/// The part of a convex polygon for which dot(normal, x) <= offset.
Polygon clipped(Polygon const& polygon, Vec3 const& normal, Real offset)
{
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        Vec3 const &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        Real const outside_a = dot(normal, a) - offset, outside_b = dot(normal, b) - offset;
        if (outside_a <= 0) result.push_back(a);
        if ((outside_a < 0 && outside_b > 0) || (outside_a > 0 && outside_b < 0))
            result.push_back(a + outside_a / (outside_a - outside_b) * (b - a));
    }
    return result;
}

struct PlaneFrame {
    Vec3 u, v; // unit, in the plane
    explicit PlaneFrame(Vec3 const& normal) : u(wall_geometry::any_perpendicular(normal)), v(cross(normal, u)) {}
    Vec3 direction(Real angle) const { return std::cos(angle) * u + std::sin(angle) * v; }
};

/// The plane through `point` as far as the domain goes. A plane on a face of the domain counts as inside.
Polygon plane_in_domain(Walls const& walls, Vec3 const& point, PlaneFrame const& frame)
{
    Vec3 const middle = (walls.lower + walls.upper) / 2;
    Real const size = norm(walls.upper - walls.lower), slack = 1e-9 * size, reach = 2 * size + norm(middle - point);
    Polygon polygon;
    for (auto const& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        polygon.push_back(point + (reach * s) * frame.u + (reach * t) * frame.v);
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 normal;
        normal[axis] = 1;
        polygon = clipped(polygon, normal, walls.upper[axis] + slack);
        polygon = clipped(polygon, -normal, -walls.lower[axis] + slack);
    }
    return polygon;
}

struct Disc {
    Vec3 center;
    Real radius = 0;
};

/// How far the ray from a point inside a convex polygon goes before it leaves it.
Real distance_to_edge(Polygon const& polygon, Vec3 const& from, Vec3 const& direction, Vec3 const& normal)
{
    Real nearest = std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        Vec3 const &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        Vec3 const outward = cross(b - a, normal);
        Real const approach = dot(outward, direction);
        if (approach > 0) nearest = std::min(nearest, std::max(dot(outward, a - from), Real(0)) / approach);
    }
    return nearest;
}

/// A convex polygon around a disc, without the disc: quads from the circle to the edge. Some reach the
/// polygon's corners, so that nothing is cut off.
void add_ring(Surface& surface, int wall, Polygon const& polygon, Disc const& hole, Vec3 const& normal)
{
    PlaneFrame const frame(normal);
    std::vector<Real> angles;
    for (int i = 0; i < circle_corners; ++i) angles.push_back(two_pi * i / circle_corners);
    for (Vec3 const& corner : polygon) {
        Real const angle = std::atan2(dot(corner - hole.center, frame.v), dot(corner - hole.center, frame.u));
        angles.push_back(angle < 0 ? angle + two_pi : angle);
    }
    std::sort(angles.begin(), angles.end());
    for (std::size_t i = 0; i < angles.size(); ++i) {
        Vec3 const d0 = frame.direction(angles[i]), d1 = frame.direction(angles[(i + 1) % angles.size()]);
        // A hole that reaches beyond the domain leaves nothing on that side.
        Real const edge0 = std::max(distance_to_edge(polygon, hole.center, d0, normal), hole.radius);
        Real const edge1 = std::max(distance_to_edge(polygon, hole.center, d1, normal), hole.radius);
        surface.add(wall, {hole.center + hole.radius * d0, hole.center + edge0 * d0, hole.center + edge1 * d1,
                           hole.center + hole.radius * d1});
    }
}

std::vector<Disc> open_holes(WallSettings const& settings, WallState const& state, WallPose const& pose, Vec3 const& axis)
{
    std::vector<Disc> discs;
    for (std::size_t h = 0; h < state.hole_open.size(); ++h) {
        if (!state.hole_open[h]) continue;
        Vec3 const offset = settings.holes[h].center - settings.point;
        discs.push_back({pose.to_world(offset - dot(offset, axis) * axis), settings.holes[h].diameter / 2});
    }
    return discs;
}

/// Each hole gets the part of the plane that is nearest to it by its power (distance2 - radius2): a convex
/// polygon that holds the hole and no other, since holes do not overlap.
void add_plane(Surface& surface, Walls const& walls, int wall, WallPose const& pose)
{
    Vec3 const normal = axis_of(walls, wall);
    Polygon const whole = plane_in_domain(walls, pose.position, PlaneFrame(normal));
    auto const holes = open_holes(walls.settings[wall], walls.state[wall], pose, walls.body[wall].axis);
    if (holes.empty()) surface.add(wall, whole);
    for (Disc const& hole : holes) {
        Polygon part = whole;
        for (Disc const& other : holes) {
            Vec3 const between = other.center - hole.center;
            Real const offset = (dot(other.center, other.center) - dot(hole.center, hole.center) -
                                 other.radius * other.radius + hole.radius * hole.radius) /
                                2;
            if (dot(between, between) > 0) part = clipped(part, between, offset);
        }
        add_ring(surface, wall, part, hole, normal);
    }
}

void add_cylinder(Surface& surface, int wall, WallBody const& body, WallPose const& pose)
{
    PlaneFrame const frame(body.axis);
    Polygon lower, upper;
    for (int i = 0; i < circle_corners; ++i) {
        Vec3 const rim = body.radius * frame.direction(two_pi * i / circle_corners);
        lower.push_back(pose.to_world(rim));
        upper.push_back(pose.to_world(rim + body.length * body.axis));
    }
    for (int i = 0; i < circle_corners; ++i) {
        int const next = (i + 1) % circle_corners;
        surface.add(wall, {lower[i], lower[next], upper[next], upper[i]});
    }
    if (body.inside) return; // a tube is open
    surface.add(wall, lower);
    surface.add(wall, upper);
}

void add_box(Surface& surface, int wall, WallBody const& body, WallPose const& pose)
{
    for (int axis = 0; axis < 3; ++axis)
        for (int side : {-1, 1}) {
            Polygon face;
            for (auto const& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
                Vec3 corner;
                corner[axis] = side * body.half[axis];
                corner[(axis + 1) % 3] = s * body.half[(axis + 1) % 3];
                corner[(axis + 2) % 3] = t * body.half[(axis + 2) % 3];
                face.push_back(pose.to_world(corner));
            }
            surface.add(wall, face);
        }
}

void add_mesh(Surface& surface, int wall, Walls const& walls, WallPose const& pose)
{
    MeshPart const& part = walls.mesh_part[wall];
    auto const rows = Kokkos::subview(walls.views.mesh.triangle,
                                      Kokkos::make_pair(part.first_triangle, part.first_triangle + part.triangles));
    auto const triangles = Kokkos::create_mirror_view_and_copy(HostSpace(), rows);
    for (int t = 0; t < part.triangles; ++t) {
        Vec3 const* const corner = triangles(t).corner;
        surface.add(wall, {pose.to_world(corner[0]), pose.to_world(corner[1]), pose.to_world(corner[2])});
    }
}

} // namespace

PolyPiece wall_surfaces(Walls const& walls, Real time)
{
    Surface surface(time);
    for (int wall = 0; wall < walls.count(); ++wall) {
        if (!walls.state[wall].present) continue;
        WallBody const& body = walls.body[wall];
        WallPose const pose = pose_of(walls.state[wall]);
        switch (body.shape) {
        case WallShape::plane:
            add_plane(surface, walls, wall, pose);
            break;
        case WallShape::cylinder:
            add_cylinder(surface, wall, body, pose);
            break;
        case WallShape::box:
            add_box(surface, wall, body, pose);
            break;
        case WallShape::mesh:
            add_mesh(surface, wall, walls, pose);
            break;
        }
    }
    return surface.finish();
}

} // namespace arenite
