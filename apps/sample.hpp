// SPDX-License-Identifier: MIT
// The sample as a block: the domain, cut by the plane walls that are present. Its porosity and the stress on a
// wall are what the stages' end conditions look at.
#pragma once

#include "core/periodic_box.hpp"
#include "core/wall_motion.hpp"
#include "core/walls.hpp"

namespace arenite {

/// The part of the domain in front of every axis-parallel plane that is present, and in every box or tube along the axes
/// that holds the grains.
Region sample_region(Walls const& walls, PeriodicBox const& domain);

/// Of that part, m3: the tubes' cross-sections are circles. Oblique walls, rods and meshes take nothing from it.
Real sample_volume(Walls const& walls, PeriodicBox const& domain);

inline Real volume_of(Region const& region)
{
    Vec3 const size = region.upper - region.lower;
    return size.x * size.y * size.z;
}

/// Area that a stress on this wall refers to: the one given, or the domain's cross-section normal to the axis.
Real loaded_area(Vec3 const& axis, Real given, PeriodicBox const& domain);

/// Compressive stress [Pa] on a plane: the force against its normal over the area.
Real wall_stress(Walls const& walls, int wall, WallReaction const& reaction, Real area, PeriodicBox const& domain);

} // namespace arenite
