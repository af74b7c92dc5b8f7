// SPDX-License-Identifier: MIT
// Grain sizes under coarse graining (paper section 2.3): k is grain diameter over original diameter.
// SSW scales every size class by k; SSP replaces all by one size, k times the mean-volume diameter
// d30 = (sum w / d^3)^(-1/3), and each grain keeps the class of the grains that it stands for.
#pragma once

#include "core/scene.hpp"

namespace arenite {

/// One size class of the grains to be made.
struct SizeClass {
    Real diameter = 0;          // m, of the grains (after coarse graining)
    Real original_diameter = 0; // m, of the original grains that it stands for
    long long count = 0;
};

/// Where grains of a distribution are placed.
inline Region generation_region(Scene const& scene)
{
    return scene.particles.distribution.region.value_or(Region{scene.domain.lower, scene.domain.upper});
}

/// d30, the diameter whose volume is the mean volume, m. fractions by mass or by number.
Real mean_volume_diameter(DistributionSettings const& distribution);

/// Classes with their counts; region_volume [m3] is what a solid_fraction refers to. Counts are rounded to
/// the largest remainder, so that they add up.
std::vector<SizeClass> make_size_classes(DistributionSettings const& distribution, CoarseGrainingSettings const& coarse,
                                         Real region_volume);

} // namespace arenite
