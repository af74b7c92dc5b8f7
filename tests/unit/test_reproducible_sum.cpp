// SPDX-License-Identifier: MIT
#include "core/reproducible_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace arenite;

namespace {

View1<Real> make_terms(int count)
{
    View1<Real> terms("terms", count);
    auto const host = Kokkos::create_mirror_view(terms);
    for (int i = 0; i < count; ++i) host(i) = std::sin(1.0 + i) * std::pow(10.0, i % 17 - 8);
    Kokkos::deep_copy(terms, host);
    return terms;
}

TEST(ReproducibleSum, IsAccurateForEveryLength)
{
    SumWorkspace sums;
    for (int const count : {0, 1, 3, 255, 256, 257, 1000, 70000}) {
        View1<Real> const terms = make_terms(count);
        long double exact = 0, size = 0;
        auto const host = Kokkos::create_mirror_view(terms);
        Kokkos::deep_copy(host, terms);
        for (int i = 0; i < count; ++i) {
            exact += host(i);
            size += std::fabs(host(i));
        }
        EXPECT_NEAR(reproducible_sum(sums, terms), Real(exact),
                    1e-15 * Real(size)); // 256 + count / 256 roundings, mostly cancelling
    }
}

// The definition: four lanes within a chunk of 256, chunks in order. Holds for any number of threads.
TEST(ReproducibleSum, IsTheDefinedOrderOnAHost)
{
    if (!on_host) GTEST_SKIP();
    int const count = 1000;
    View1<Real> const terms = make_terms(count);
    auto const host = Kokkos::create_mirror_view(terms);
    Kokkos::deep_copy(host, terms);
    Real total = 0;
    for (int c = 0; c < count; c += 256) {
        Real lane[4] = {};
        for (int i = c; i < std::min(c + 256, count); ++i) lane[i % 4] += host(i);
        total += (lane[0] + lane[1]) + (lane[2] + lane[3]);
    }
    SumWorkspace sums;
    EXPECT_EQ(reproducible_sum(sums, terms), total);
}

TEST(ReproducibleSum, DotProductOfOnesCounts)
{
    SumWorkspace sums;
    View1<Real> const ones("ones", 12345);
    Kokkos::deep_copy(ones, Real(1));
    EXPECT_EQ(reproducible_dot(sums, ones, ones), 12345);
}

struct Record { // two numbers of its four are wanted
    Quad quad{};
    [[maybe_unused]] KOKKOS_FUNCTION Record& operator+=(Record const& other) // a device adds the numbers
    {
        quad += other.quad;
        return *this;
    }
    KOKKOS_FUNCTION Terms<2> numbers() const { return {{quad[0] + quad[1], quad[3]}}; }
};
struct Multiples {
    KOKKOS_FUNCTION Record operator()(int i) const
    {
        Real const x = i;
        return {Quad{x, 2 * x, 3 * x, 4 * x}};
    }
};

struct Lanewise { // item i and twice that, lane_count items at a time
    KOKKOS_FUNCTION LaneTerms<2> operator()(int block) const
    {
        Lanes const items = make_lanes([&](int lane) { return Real(block * lane_count + lane); });
        return {{items, 2 * items}};
    }
};

TEST(ReproducibleSum, TakesRecordsAndLanes)
{
    SumWorkspace sums;
    for (int const count : {1, 255, 1000, 70000}) {
        Real const expected = Real(0.5) * count * (count - 1); // exact
        Terms<2> const records = reproducible_sums<2>(sums, "records", count, Multiples{});
        EXPECT_EQ(records[0], 3 * expected) << count;
        EXPECT_EQ(records[1], 4 * expected) << count;
        Real const items = Real(count) * lane_count;
        Terms<2> const lanes = reproducible_sums<2>(sums, "lanes", count, Lanewise{});
        for (int n = 0; n < 2; ++n) EXPECT_EQ(lanes[n], (n + 1) * Real(0.5) * items * (items - 1)) << count;
    }
}

} // namespace
