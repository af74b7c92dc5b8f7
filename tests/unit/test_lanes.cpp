// SPDX-License-Identifier: MIT
// The vectors of the pair kernel: reciprocals and inverse roots of every magnitude that forces and lengths have.
#include "core/lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace arenite {
namespace {

/// A function of lanes beside its reference, over 100 decades to either side of 1.
template <class OfLanes, class Reference> void expect_two_roundings(OfLanes const& of_lanes, Reference const& reference)
{
    std::mt19937_64 random(5);
    std::uniform_real_distribution<Real> exponent(-100, 100);
    Real worst = 0;
    for (int block = 0; block < 20000; ++block) {
        Real numbers[lane_count];
        for (Real& number : numbers) number = std::pow(Real(10), exponent(random));
        Lanes const found = of_lanes(load_lanes(numbers));
        for (int n = 0; n < lane_count; ++n) {
            long double const expected = reference(static_cast<long double>(numbers[n]));
            worst = std::max(worst, static_cast<Real>(std::fabs(lane(found, n) / expected - 1)));
        }
    }
    EXPECT_LT(worst, 2 * 2.220446049250313e-16);
    EXPECT_GT(worst, 0); // the reference has more digits, or it would say nothing
}

TEST(Lanes, ReciprocalsAreGoodToTwoRoundings)
{
    expect_two_roundings([](Lanes const& a) { return reciprocal(a); }, [](long double a) { return 1 / a; });
}

TEST(Lanes, InverseRootsAreGoodToTwoRoundings)
{
    expect_two_roundings([](Lanes const& a) { return inverse_root(a); }, [](long double a) { return 1 / std::sqrt(a); });
}

TEST(Lanes, AnInverseRootOfNothingCutsNothing)
{
    for (Real const limit : {0.0, 3.0}) {
        Lanes const factor = smaller(Lanes(limit) * inverse_root(Lanes(0)), Lanes(1));
        for (int n = 0; n < lane_count; ++n) EXPECT_EQ(lane(factor, n), 1) << "limit " << limit;
    }
}

} // namespace
} // namespace arenite
