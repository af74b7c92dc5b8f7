// SPDX-License-Identifier: MIT
// What a normal law takes and gives: numbers in, numbers out.
#pragma once

#include "core/material.hpp"

namespace arenite {

/// A pair's sizes, computed once when the contact list is built.
struct ContactScale {
    Real effective_radius = 0;      // R*, m: 1/R* = 1/R_i + 1/R_j
    Real effective_mass = 0;        // m*, kg
    Real cube_root_of_radius = 0;   // R*^(1/3), which the JKR lengths need
};

struct NormalResponse {
    Real force = 0;          // N, positive pushes apart
    Real contact_radius = 0; // a, m
    Real pull_off_force = 0; // F_C = 3 pi gamma R*, N, positive; 0 where the contact does not adhere
    bool touches = false;
    Real dashpot = 0;        // N s/m, 2 sqrt(5/6) beta sqrt(S_n m*); set by the contact law
};

} // namespace arenite
