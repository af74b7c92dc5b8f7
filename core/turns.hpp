// SPDX-License-Identifier: MIT
// Work in turns, a stretch of it each. On a host a thread begins with its own share of the turns, the same from step to
// step, so that what it touches stays in its caches; then it takes turns that others have left. So a core that is slowed, by
// a neighbour on a shared machine or by other work, does not keep the rest waiting. Which thread takes a turn changes no
// bits, where a turn writes only what is its own. On a device a turn is a thread's.
#pragma once

#include "core/types.hpp"

#include <vector>

namespace arenite {

/// Of a thread's share; two cache lines, which processors fetch in pairs.
struct alignas(128) TurnsLeft {
    int next = 0, end = 0;
};

template <class Turn> struct SharedTurns {
    Turn turn;
    TurnsLeft* left; // [thread]
    int threads;

    KOKKOS_FORCEINLINE_FUNCTION void operator()(int thread) const
    {
        // Its own share first, then those 1, 2, 4, ... threads away: to look at all of them would with many threads take as
        // long as the work. A single place calls the turn, since GCC makes a pair kernel that it has to copy a tenth slower.
        for (int away = 0; away < threads; away = away > 0 ? 2 * away : 1) {
            TurnsLeft& share = left[(thread + away) % threads];
            int k = Kokkos::atomic_load(&share.next);
            while (k < share.end && (k = Kokkos::atomic_fetch_add(&share.next, 1)) < share.end) turn(k);
        }
    }
};

/// The shares of `count` turns, [thread]. Launches on a host are over when they return, and one thread makes them all.
inline TurnsLeft* shares_of(int count, int threads)
{
    static std::vector<TurnsLeft> left;
    left.resize(threads);
    auto const first_of = [&](int thread) { return static_cast<int>(static_cast<long long>(count) * thread / threads); };
    for (int thread = 0; thread < threads; ++thread) left[thread] = {first_of(thread), first_of(thread + 1)};
    return left.data();
}

/// turn(k) for k = 0 .. count - 1, in any order and side by side. DevicePolicy: how a device does that.
template <class DevicePolicy = RangePolicy, class Turn>
void for_each_turn(std::string const& label, int count, Turn const& turn)
{
    if constexpr (on_host) {
        int const threads = ExecutionSpace().concurrency();
        Kokkos::parallel_for(label, RangePolicy(0, threads, Kokkos::ChunkSize(1)),
                             SharedTurns<Turn>{turn, shares_of(count, threads), threads});
    } else {
        Kokkos::parallel_for(label, DevicePolicy(0, count), turn);
    }
}

} // namespace arenite
