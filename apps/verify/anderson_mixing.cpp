// SPDX-License-Identifier: MIT
#include "apps/verify/anderson_mixing.hpp"

#include <cmath>
#include <numeric>
#include <utility>

namespace arenite {
namespace {

constexpr std::size_t most_differences = 20;
constexpr Real independent = 1e-6; // share of a residual that the newer ones must leave over: beyond is rounding

Real dot(std::vector<Real> const& a, std::vector<Real> const& b)
{
    return std::inner_product(a.begin(), a.end(), b.begin(), Real(0));
}

void add(std::vector<Real>& sum, Real factor, std::vector<Real> const& a)
{
    for (std::size_t i = 0; i < a.size(); ++i) sum[i] += factor * a[i];
}

} // namespace

std::vector<Real> AndersonMixing::next_point(std::vector<Real> const& point, std::vector<Real> const& image)
{
    Pair here{image, image};
    add(here.residual, -1, point);
    if (!last_.image.empty()) {
        Pair difference = here;
        add(difference.image, -1, last_.image);
        add(difference.residual, -1, last_.residual);
        differences_.push_front(std::move(difference));
        if (differences_.size() > most_differences) differences_.pop_back();
    }
    last_ = here;

    // Least squares by modified Gram-Schmidt: the residual loses what the differences span, the image follows.
    std::vector<Pair> basis;
    for (Pair direction : differences_) {
        Real const length = std::sqrt(dot(direction.residual, direction.residual));
        for (Pair const& newer : basis) {
            Real const share = dot(newer.residual, direction.residual);
            add(direction.residual, -share, newer.residual);
            add(direction.image, -share, newer.image);
        }
        Real const left = std::sqrt(dot(direction.residual, direction.residual));
        if (!(left > independent * length)) continue;
        for (Real& value : direction.residual) value /= left;
        for (Real& value : direction.image) value /= left;
        Real const share = dot(direction.residual, here.residual);
        add(here.residual, -share, direction.residual);
        add(here.image, -share, direction.image);
        basis.push_back(std::move(direction));
    }
    return here.image;
}

} // namespace arenite
