// SPDX-License-Identifier: MIT
#include "io/scene/check.hpp"

#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace arenite::scene {
namespace {

void check_wall(Scene const& scene, WallSettings const& w, std::string const& path, Faults& faults)
{
    if (faults.given(path + ".material"))
        check_name(w.material, names_of(scene.materials), "material", path + ".material", faults);
    if (w.shape == WallShape::plane && faults.given(path + ".normal") && !(norm(w.normal) > 0))
        faults.add(path + ".normal", "must not be [0, 0, 0]");
    for (std::size_t h = 0; w.shape == WallShape::plane && h < w.holes.size(); ++h) {
        if (!(norm(w.normal) > 0)) break;
        Vec3 const normal = normalized(w.normal),
                   center = w.holes[h].center + dot(w.point - w.holes[h].center, normal) * normal;
        Vec3 beyond;
        for (int axis = 0; axis < 3; ++axis)
            beyond[axis] =
                std::max({Real(0), scene.domain.lower[axis] - center[axis], center[axis] - scene.domain.upper[axis]});
        std::string const hole = element(path + ".holes", h, w.holes[h].name);
        if (norm(beyond) > w.holes[h].diameter / 2 &&
            !faults.any_faulty({"domain.lower", "domain.upper", hole + ".center", hole + ".diameter"}))
            faults.add(hole, "lies outside the domain");
    }
    if (w.shape == WallShape::cylinder && faults.given(path + ".axis") && !(norm(w.axis) > 0))
        faults.add(path + ".axis", "must not be [0, 0, 0]");
    if (w.shape == WallShape::box && faults.given(path + ".lower") && faults.given(path + ".upper"))
        check_region(w.box, path, faults);
    if (w.shape == WallShape::mesh && !w.file.empty() && !is_file(path_of(scene, w.file)))
        faults.add(path + ".file", fmt::format("there is no file {}", path_of(scene, w.file)));
}

/// True if nothing of the wall's shape is missing or degenerate.
bool is_sound(WallSettings const& w)
{
    switch (w.shape) {
    case WallShape::plane:
        return norm(w.normal) > 0;
    case WallShape::cylinder:
        return norm(w.axis) > 0 && w.diameter > 0;
    case WallShape::box:
        return w.box.lower.x < w.box.upper.x && w.box.lower.y < w.box.upper.y && w.box.lower.z < w.box.upper.z;
    case WallShape::mesh:
        return false; // meshes are not looked at
    }
    return false;
}

bool is_body(WallSettings const& w) { return !w.inside && (w.shape == WallShape::cylinder || w.shape == WallShape::box); }

constexpr Real not_there = -1e300; // depth where a wall has no say

Real depth_in_plane(WallSettings const& w, Vec3 const& p)
{
    Vec3 const normal = normalized(w.normal);
    for (HoleSettings const& hole : w.holes) {
        Vec3 const to_hole = p - hole.center;
        if (norm(to_hole - dot(to_hole, normal) * normal) <= hole.diameter / 2 * (1 + 1e-12)) return not_there;
    }
    return dot(w.point - p, normal);
}

Real depth_in_cylinder(WallSettings const& w, Vec3 const& p)
{
    Real const length = norm(w.axis), radius = w.diameter / 2;
    Vec3 const axis = w.axis / length;
    Real const along = dot(p - w.base, axis);
    Real const across = norm(p - w.base - along * axis);
    if (w.inside) return along > 0 && along < length ? across - radius : not_there;
    return std::min({radius - across, along, length - along});
}

Real depth_in_box(WallSettings const& w, Vec3 const& p)
{
    Real depth = 1e300;
    for (int axis = 0; axis < 3; ++axis) depth = std::min({depth, p[axis] - w.box.lower[axis], w.box.upper[axis] - p[axis]});
    return w.inside ? -depth : depth;
}

/// How far a point is inside the wall's solid, m; negative outside.
Real depth(WallSettings const& w, Vec3 const& p)
{
    if (w.shape == WallShape::plane) return depth_in_plane(w, p);
    return w.shape == WallShape::cylinder ? depth_in_cylinder(w, p) : depth_in_box(w, p);
}

/// Points all over a rod or block, its rims and corners among them.
std::vector<Vec3> sample(WallSettings const& w)
{
    constexpr int steps = 16;
    std::vector<Vec3> points;
    if (w.shape == WallShape::box) {
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; j <= steps; ++j)
                for (int k = 0; k <= steps; ++k) {
                    Vec3 const size = w.box.upper - w.box.lower;
                    points.push_back(w.box.lower + Vec3{size.x * i / steps, size.y * j / steps, size.z * k / steps});
                }
        return points;
    }
    Vec3 const axis = normalized(w.axis);
    Vec3 const u = normalized(cross(axis, std::abs(axis.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})), v = cross(axis, u);
    for (int i = 0; i <= steps; ++i)
        for (int ring = 0; ring <= 4; ++ring)
            for (int j = 0; j < 2 * steps; ++j) {
                Real const angle = Real(3.14159265358979) * j / steps, radius = w.diameter / 2 * ring / 4;
                points.push_back(w.base + Real(i) / steps * w.axis + radius * std::cos(angle) * u +
                                 radius * std::sin(angle) * v);
            }
    return points;
}

bool reaches_into(WallSettings const& body, WallSettings const& other, Real tolerance)
{
    for (Vec3 const& point : sample(body))
        if (depth(other, point) > tolerance) return true;
    return false;
}

/// A body may stand before a plane or wait behind it, be in a vessel or outside, but not across its surface.
bool crosses(WallSettings const& body, WallSettings const& surface, Real tolerance)
{
    bool in_front = false, behind = false;
    for (Vec3 const& point : sample(body)) {
        Real const d = depth(surface, point);
        if (d == not_there) continue;
        in_front = in_front || d < -tolerance;
        behind = behind || d > tolerance;
    }
    return in_front && behind;
}

/// "" or what is wrong between two surfaces that hold grains in.
std::string clash_of_surfaces(WallSettings const& a, WallSettings const& b, Real tolerance)
{
    if (a.shape != b.shape) return "";
    constexpr Real parallel = 1 - 1e-12;
    if (a.shape == WallShape::plane) {
        Vec3 const normal = normalized(a.normal);
        Real const cosine = dot(normal, normalized(b.normal)), gap = dot(b.point - a.point, normal);
        if (cosine > parallel && std::abs(gap) <= tolerance) return "is the same plane as";
        if (cosine < -parallel && gap <= tolerance) return "leaves no room between itself and";
        return "";
    }
    if (a.shape == WallShape::box) return a.box == b.box ? "is the same box as" : "";
    return a.base == b.base && a.axis == b.axis && a.diameter == b.diameter ? "is the same cylinder as" : "";
}

std::string clash(WallSettings const& a, WallSettings const& b, Real tolerance)
{
    if (is_body(a) && is_body(b)) return reaches_into(a, b, tolerance) || reaches_into(b, a, tolerance) ? "overlaps" : "";
    if (is_body(a)) return crosses(a, b, tolerance) ? "overlaps" : "";
    if (is_body(b)) return crosses(b, a, tolerance) ? "overlaps" : "";
    return clash_of_surfaces(a, b, tolerance);
}

} // namespace

void check_walls(Scene const& scene, Faults& faults)
{
    for (std::size_t i = 0; i < scene.walls.size(); ++i)
        check_wall(scene, scene.walls[i], element("walls", i, scene.walls[i].name), faults);
}

void check_wall_overlaps(Scene const& scene, Faults& faults)
{
    Real const tolerance = 1e-9 * norm(scene.domain.upper - scene.domain.lower); // touching is fine
    for (std::size_t j = 0; j < scene.walls.size(); ++j)
        for (std::size_t i = 0; i < j; ++i) {
            WallSettings const &a = scene.walls[i], &b = scene.walls[j];
            if (!a.present || !b.present || !is_sound(a) || !is_sound(b)) continue;
            std::string const what = clash(b, a, tolerance);
            if (what.empty()) continue;
            faults.add(element("walls", j, b.name),
                       fmt::format("{} wall {} at the start: move one, or make it present = false "
                                   "until a stage adds it",
                                   what, element("walls", i, a.name).substr(6)));
        }
}

} // namespace arenite::scene
