// SPDX-License-Identifier: MIT
#include "core/turns.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace arenite {
namespace {

/// How often each turn was taken. The turns of the first half take `work` roots each.
std::vector<int> times_taken(int count, int work)
{
    View1<int> const taken("taken", count);
    for_each_turn(
        "take", count, KOKKOS_LAMBDA(int k) {
            double sum = 0;
            for (int n = 0; n < (2 * k < count ? work : 0); ++n) sum += Kokkos::sqrt(double(n + k));
            Kokkos::atomic_add(&taken(k), sum < 0 ? 0 : 1);
        });
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), taken);
    return {host.data(), host.data() + count};
}

TEST(Turns, EachIsTakenOnce)
{
    for (int const count : {0, 1, 2, 3, 7, 64, 100000}) EXPECT_EQ(times_taken(count, 0), std::vector<int>(count, 1));
}

TEST(Turns, EachIsTakenOnceWhereOneThreadHasAllTheWork)
{
    for (int repeat = 0; repeat < 20; ++repeat) EXPECT_EQ(times_taken(512, 10000), std::vector<int>(512, 1));
}

} // namespace
} // namespace arenite
