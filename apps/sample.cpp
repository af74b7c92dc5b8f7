// SPDX-License-Identifier: MIT
#include "apps/sample.hpp"

#include <algorithm>
#include <cmath>

namespace arenite {
namespace {

/// The axis that a unit vector is parallel to, or -1.
int parallel_axis(Vec3 const& unit)
{
    for (int axis = 0; axis < 3; ++axis)
        if (std::fabs(std::fabs(unit[axis]) - 1) < Real(1e-12)) return axis;
    return -1;
}

} // namespace

Region sample_region(Walls const& walls, PeriodicBox const& domain)
{
    Region region{domain.lower, domain.upper};
    for (int w = 0; w < walls.count(); ++w) {
        if (walls.settings[w].shape != WallShape::plane || !walls.state[w].present) continue;
        Vec3 const normal = axis_of(walls, w);
        int const axis = parallel_axis(normal);
        if (axis < 0) continue;
        Real const at = walls.state[w].position[axis];
        if (normal[axis] > 0) region.lower[axis] = std::max(region.lower[axis], at);
        else region.upper[axis] = std::min(region.upper[axis], at);
    }
    return region;
}

Real loaded_area(Vec3 const& axis, Real given, PeriodicBox const& domain)
{
    if (given > 0) return given;
    Vec3 const size = domain.size();
    return size.x * size.y * size.z / std::fabs(dot(size, axis));
}

Real wall_stress(Walls const& walls, int wall, WallReaction const& reaction, Real area, PeriodicBox const& domain)
{
    Vec3 const normal = axis_of(walls, wall);
    return -dot(reaction.force, normal) / loaded_area(normal, area, domain);
}

} // namespace arenite
