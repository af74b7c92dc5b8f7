// SPDX-License-Identifier: MIT
// The scalar type, with functions for host and device code, and no Views: what only describes a study (core/scene.hpp, the
// scene reader, the tables) does without the rest of Kokkos, which takes a compiler longer to read than all of ours.
#pragma once

#include <Kokkos_Macros.hpp>
#include <Kokkos_MathematicalFunctions.hpp>

#include <cstdint>

namespace arenite {

using Real = double; // positions need it: a float ULP at 18 mm is 2 % of a JKR pull-off overlap

using GrainId = std::int64_t; // global, never reused: contacts, bonds and random numbers are keyed by it

} // namespace arenite
