// SPDX-License-Identifier: MIT
// Fills the two halo layers of the flow's fields: periodic images, or what the boundary implies.
#pragma once

#include "fluid/boundary.hpp"
#include "fluid/flow.hpp"

namespace arenite {

/// Cell fields: the periodic image, or the nearest cell's value, so that the mean at a boundary face is the
/// boundary cell's own value.
void fill_cell_halos(Flow const& flow);

/// Velocities: periodic images; across a boundary the tangential components are mirrored through the
/// boundary's velocity (or copied where it is free of shear) and the normal one goes on in a straight line.
void fill_velocity_halos(Flow const& flow, FlowBoundary const& boundary);

/// Both.
void fill_halos(Flow const& flow, FlowBoundary const& boundary);

} // namespace arenite
