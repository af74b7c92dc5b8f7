// SPDX-License-Identifier: MIT
// The characteristic points of the universal JKR curve, in units of L = (pi^2 gamma^2 R*/E*^2)^(1/3) for
// overlaps and of pi gamma R* for forces (Johnson, Kendall & Roberts 1971; paper table 1). With
// s = a / (pi gamma R*^2/E*)^(1/3): overlap = s^2 - 2 sqrt(s), force = 4/3 s^3 - 4 s^(3/2).
#pragma once

#include "core/real.hpp"

namespace arenite::jkr_points {

inline constexpr Real overlap_S = -1.1905507889761495; // -3 * 2^(-4/3): the unstable end, vertical tangent
inline constexpr Real overlap_C = -0.5723571212766660; // -(3/4) (4/9)^(1/3): the maximum tension
inline constexpr Real overlap_A = 0;                   // touch
inline constexpr Real overlap_B = 1.4422495703074083;  // 3^(1/3): no force
inline constexpr Real force_S = -5.0 / 3;
inline constexpr Real force_C = -3;
inline constexpr Real force_A = -8.0 / 3;

} // namespace arenite::jkr_points
