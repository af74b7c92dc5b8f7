// SPDX-License-Identifier: MIT
#pragma once

#include <Kokkos_Core.hpp>

#include <chrono>

namespace arenite {

inline double seconds_since(std::chrono::steady_clock::time_point begin)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Wall time of the work, s; what was launched before is over when it begins, and what it launches when it ends.
template <class Work> double seconds_of(Work const& work)
{
    Kokkos::fence();
    auto const begin = std::chrono::steady_clock::now();
    work();
    Kokkos::fence();
    return seconds_since(begin);
}

} // namespace arenite
