// SPDX-License-Identifier: MIT
#include "core/coarse_graining.hpp"

#include "core/grain.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace arenite {
namespace {

Real volume_of(Real diameter) { return sphere_volume(diameter / 2); }

/// Share of the grains, by number, that each class has.
std::vector<Real> number_fractions(DistributionSettings const& distribution)
{
    std::vector<Real> shares = distribution.fractions;
    if (distribution.by_mass)
        for (std::size_t c = 0; c < shares.size(); ++c) shares[c] /= volume_of(distribution.diameters[c]);
    Real const sum = std::accumulate(shares.begin(), shares.end(), Real(0));
    for (Real& share : shares) share /= sum;
    return shares;
}

std::vector<Real> mass_fractions(DistributionSettings const& distribution)
{
    std::vector<Real> shares = number_fractions(distribution);
    for (std::size_t c = 0; c < shares.size(); ++c) shares[c] *= volume_of(distribution.diameters[c]);
    Real const sum = std::accumulate(shares.begin(), shares.end(), Real(0));
    for (Real& share : shares) share /= sum;
    return shares;
}

/// Whole numbers that add up to total in the given shares.
std::vector<long long> apportion(std::vector<Real> const& shares, long long total)
{
    std::vector<long long> counts(shares.size());
    std::vector<std::size_t> order(shares.size());
    std::iota(order.begin(), order.end(), 0);
    long long given = 0;
    for (std::size_t c = 0; c < shares.size(); ++c)
        given += counts[c] = static_cast<long long>(std::floor(shares[c] * total));
    auto const remainder = [&](std::size_t c) { return shares[c] * total - static_cast<Real>(counts[c]); };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return remainder(a) > remainder(b); });
    for (std::size_t n = 0; given < total; n = (n + 1) % order.size(), ++given) ++counts[order[n]];
    return counts;
}

} // namespace

Real mean_volume_diameter(DistributionSettings const& distribution)
{
    std::vector<Real> const shares = number_fractions(distribution);
    Real mean = 0;
    for (std::size_t c = 0; c < shares.size(); ++c) mean += shares[c] * std::pow(distribution.diameters[c], 3);
    return std::cbrt(mean);
}

std::vector<SizeClass> make_size_classes(DistributionSettings const& distribution, CoarseGrainingSettings const& coarse,
                                         Real region_volume)
{
    bool const one_size = coarse.scheme == CoarseGraining::ssp;
    Real const mean = mean_volume_diameter(distribution);
    // SSW keeps the classes' shares by number; SSP's grains weigh the same, so their shares are those by mass.
    std::vector<Real> const shares = one_size ? mass_fractions(distribution) : number_fractions(distribution);
    std::vector<SizeClass> classes(shares.size());
    Real mean_volume = 0;
    for (std::size_t c = 0; c < shares.size(); ++c) {
        classes[c].original_diameter = distribution.diameters[c];
        classes[c].diameter = coarse.factor * (one_size ? mean : distribution.diameters[c]);
        mean_volume += shares[c] * volume_of(classes[c].diameter);
    }
    Real const solid =
        distribution.solid_volume > 0 ? distribution.solid_volume : distribution.solid_fraction * region_volume;
    long long const total = distribution.count > 0 ? distribution.count : std::llround(solid / mean_volume);
    std::vector<long long> const counts = apportion(shares, total);
    for (std::size_t c = 0; c < shares.size(); ++c) classes[c].count = counts[c];
    return classes;
}

} // namespace arenite
