// SPDX-License-Identifier: MIT
// Puts grains of given size classes into a box at random without overlap: random sequential addition, the
// largest first, on the host (set-up, not part of a step). Reaches a solid fraction of about 0.36.
#pragma once

#include "core/coarse_graining.hpp"
#include "core/particles.hpp"

#include <functional>

namespace arenite {

/// Grains wholly inside region, of material row `material`, at rest, numbered from 0 from the largest size down.
/// Same grains for the same seed. may_stand(x, radius): whether anything else, a wall, leaves a grain this place. Throws
/// InputError when the region is too full: says what fraction was asked for and how many fitted.
std::vector<Grain> pack_at_random(std::vector<SizeClass> const& classes, Region const& region, int material,
                                  unsigned long long seed, std::function<bool(Vec3 const&, Real)> const& may_stand);

} // namespace arenite
