// SPDX-License-Identifier: MIT
// The JKR curve a second time, by another method and in longer numbers, to check the kernels' against.
#pragma once

#include "apps/verify/materials.hpp"

namespace arenite {

/// y = sqrt(s) of the stable branch for overlap / L = y^4 - 2 y >= that of S, by bisection.
long double reference_root(long double scaled_overlap);

/// Force / F_C at overlap / L.
long double reference_force(long double scaled_overlap);

/// Dimensional points of a pair (physics.md's closed forms, in long double inside).
struct JkrPoints {
    Real length;                          // L, m
    Real pull_off_force;                  // F_C, N
    Real overlap_C, overlap_B, overlap_S; // m
    Real radius_C;                        // a at C, m
    Real stiffness_B;                     // dF/d overlap at B, N/m
    Real work_CA, work_SA;                // J, to peel from A to C and to S
    Real peel_unit;                       // (gamma^5 R*^4 / E*^2)^(1/3), J
};

JkrPoints jkr_points_of(PairConstants const& pair, Real effective_radius);

} // namespace arenite
