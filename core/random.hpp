// SPDX-License-Identifier: MIT
// Counter-based random numbers: the value depends on (seed, stream, draw) alone, so any order of asking and
// any thread count gives the same grains. Mixing: the finaliser of SplitMix64 (Steele, Lea & Flood 2014),
// applied once per key.
#pragma once

#include "core/real.hpp"

namespace arenite {

KOKKOS_FUNCTION constexpr std::uint64_t mix_bits(std::uint64_t x)
{
    x += 0x9E3779B97F4A7C15ull;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
}

KOKKOS_FUNCTION constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t draw)
{
    return mix_bits(mix_bits(mix_bits(seed) ^ stream) ^ draw);
}

/// Uniform in [0, 1), 53 bits.
KOKKOS_FUNCTION constexpr Real random_uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t draw)
{
    return static_cast<Real>(random_bits(seed, stream, draw) >> 11) * 0x1p-53;
}

} // namespace arenite
