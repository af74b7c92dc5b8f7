// SPDX-License-Identifier: MIT
// Functions of vectors: reciprocals and inverse roots of every magnitude that forces and lengths have, and what drag laws
// ask for.
#include "core/lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace arenite {
namespace {

constexpr Real last_digit = 2.220446049250313e-16;

/// Largest relative difference of a function of lanes from its reference, over numbers that make(u) gives for u from -1
/// to 1.
template <class OfLanes, class Reference, class Make>
Real largest_difference(OfLanes const& of_lanes, Reference const& reference, Make const& make)
{
    std::mt19937_64 random(5);
    std::uniform_real_distribution<Real> u(-1, 1);
    Real worst = 0;
    for (int block = 0; block < 20000; ++block) {
        Real numbers[lane_count];
        for (Real& number : numbers) number = make(u(random));
        Lanes const found = of_lanes(load_lanes(numbers));
        for (int n = 0; n < lane_count; ++n) {
            long double const expected = reference(static_cast<long double>(numbers[n]));
            worst = std::max(worst, static_cast<Real>(std::fabs(lane(found, n) / expected - 1)));
        }
    }
    EXPECT_GT(worst, 0); // the reference has more digits, or it would say nothing
    return worst;
}

Real hundred_decades(Real u) { return std::pow(Real(10), 100 * u); } // to either side of 1

TEST(Lanes, ReciprocalsAreGoodToTwoRoundings)
{
    EXPECT_LT(largest_difference([](Lanes const& a) { return reciprocal(a); }, [](long double a) { return 1 / a; },
                                 hundred_decades),
              2 * last_digit);
}

TEST(Lanes, InverseRootsAreGoodToTwoRoundings)
{
    EXPECT_LT(largest_difference([](Lanes const& a) { return inverse_root(a); },
                                 [](long double a) { return 1 / std::sqrt(a); }, hundred_decades),
              2 * last_digit);
}

TEST(Lanes, ExponentialsLogarithmsAndPowersAreGoodToFourUnits)
{
    EXPECT_LT(largest_difference([](Lanes const& a) { return exponential(a); }, [](long double a) { return std::exp(a); },
                                 [](Real u) { return 700 * u; }),
              4 * last_digit);
    EXPECT_LT(largest_difference([](Lanes const& a) { return logarithm(a); }, [](long double a) { return std::log(a); },
                                 hundred_decades),
              4 * last_digit);
    for (Real const exponent : {-3.7, 0.687, 2.5})
        EXPECT_LT(largest_difference([&](Lanes const& a) { return power(a, Lanes(exponent)); },
                                     [&](long double a) { return std::pow(a, static_cast<long double>(exponent)); },
                                     [](Real u) { return std::pow(Real(10), 12 * u); }),
                  4 * last_digit)
            << exponent;
}

/// At rest a drag law asks for these.
TEST(Lanes, FunctionsOfNothingAreTheCLibrarys)
{
    Real const infinity = std::numeric_limits<Real>::infinity();
    for (int n = 0; n < lane_count; ++n) {
        EXPECT_EQ(lane(logarithm(Lanes(0)), n), -infinity);
        EXPECT_EQ(lane(exponential(Lanes(-infinity)), n), 0);
        EXPECT_EQ(lane(power(Lanes(0), Lanes(0.687)), n), 0);
        EXPECT_EQ(lane(power(Lanes(1), Lanes(-3.7)), n), 1);
    }
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
