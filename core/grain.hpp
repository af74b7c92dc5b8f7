// SPDX-License-Identifier: MIT
// One grain on the host, as a size distribution or a CSV file makes it.
#pragma once

#include "core/vec3.hpp"

#include <numbers>

namespace arenite {

/// How a grain moves.
enum class Motion : std::uint8_t {
    free = 0,
    held = 1,       // neither moves nor turns, feels and exerts forces
    prescribed = 2, // keeps its velocity and spin whatever the forces
};

KOKKOS_INLINE_FUNCTION Real sphere_volume(Real radius)
{
    return Real(4) / 3 * std::numbers::pi_v<Real> * radius * radius * radius;
}

/// Contacts with walls are sorted by keys that hold 34 bits of an id.
inline constexpr GrainId largest_grain_id = (GrainId(1) << 34) - 1;

struct Grain {
    Vec3 position;     // m
    Real diameter = 0; // m
    Vec3 velocity;     // m/s
    Vec3 spin;         // rad/s
    int material = 0;  // row of the material table
    int size_class = 0;
    GrainId id = -1; // -1: numbered in order
    Motion motion = Motion::free;
    Vec3 applied_force; // N
};

} // namespace arenite
