// SPDX-License-Identifier: MIT
#include "apps/sample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arenite {
namespace {

/// The axis that a unit vector is parallel to, or -1.
int parallel_axis(Vec3 const& unit)
{
    for (int axis = 0; axis < 3; ++axis)
        if (std::fabs(std::fabs(unit[axis]) - 1) < Real(1e-12)) return axis;
    return -1;
}

/// A box that holds the grains and stands along the axes.
bool is_upright_vessel(Walls const& walls, int w)
{
    return walls.settings[w].shape == WallShape::box && walls.settings[w].inside && walls.state[w].present &&
           walls.state[w].orientation == Quaternion{1, 0, 0, 0};
}

/// Of a tube that holds the grains, or -1.
int tube_axis(Walls const& walls, int w)
{
    bool const tube = walls.settings[w].shape == WallShape::cylinder && walls.settings[w].inside && walls.state[w].present;
    return tube ? parallel_axis(axis_of(walls, w)) : -1;
}

Vec3 smaller_of(Vec3 const& a, Vec3 const& b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 larger_of(Vec3 const& a, Vec3 const& b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

} // namespace

Region sample_region(Walls const& walls, PeriodicBox const& domain)
{
    Region region{domain.lower, domain.upper};
    auto const cut = [&](Vec3 const& lower, Vec3 const& upper, int axis) {
        region.lower[axis] = std::max(region.lower[axis], lower[axis]);
        region.upper[axis] = std::min(region.upper[axis], upper[axis]);
    };
    for (int w = 0; w < walls.count(); ++w) {
        if (!walls.state[w].present) continue;
        Vec3 const position = walls.state[w].position;
        if (is_upright_vessel(walls, w))
            for (int axis = 0; axis < 3; ++axis) cut(position - walls.body[w].half, position + walls.body[w].half, axis);
        if (int const axis = tube_axis(walls, w); axis >= 0) {
            Vec3 const end = position + walls.body[w].length * axis_of(walls, w);
            cut(smaller_of(position, end), larger_of(position, end), axis);
        }
        if (walls.settings[w].shape != WallShape::plane) continue;
        Vec3 const normal = axis_of(walls, w);
        int const axis = parallel_axis(normal);
        if (axis < 0) continue;
        Real const at = walls.state[w].position[axis];
        if (normal[axis] > 0) region.lower[axis] = std::max(region.lower[axis], at);
        else region.upper[axis] = std::min(region.upper[axis], at);
    }
    return region;
}

Real sample_volume(Walls const& walls, PeriodicBox const& domain)
{
    Region const region = sample_region(walls, domain);
    Vec3 const size = region.upper - region.lower;
    Real volume = volume_of(region);
    for (int w = 0; w < walls.count(); ++w) {
        int const along = tube_axis(walls, w);
        if (along < 0) continue;
        Real const radius = walls.body[w].radius, area = std::numbers::pi_v<Real> * radius * radius;
        Vec3 const center = walls.state[w].position;
        bool within = true; // the circle lies in the region
        for (int axis = 0; axis < 3; ++axis)
            within = within && (axis == along || (center[axis] - radius >= region.lower[axis] - Real(1e-9) * radius &&
                                                  center[axis] + radius <= region.upper[axis] + Real(1e-9) * radius));
        if (within) volume = std::min(volume, area * size[along]);
    }
    return volume;
}

Real loaded_area(Vec3 const& axis, Real given, PeriodicBox const& domain)
{
    if (given > 0) return given;
    return cross_section(domain.size(), axis);
}

Real wall_stress(Walls const& walls, int wall, WallReaction const& reaction, Real area, PeriodicBox const& domain)
{
    Vec3 const normal = axis_of(walls, wall);
    return -dot(reaction.force, normal) / loaded_area(normal, area, domain);
}

} // namespace arenite
