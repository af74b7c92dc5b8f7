// SPDX-License-Identifier: MIT
// What a normal law takes and gives: numbers in, numbers out.
#pragma once

#include "core/lanes.hpp"
#include "core/material.hpp"

namespace arenite {

/// A pair's sizes, computed once when the contact list is built.
template <class N = Real> struct ContactScale {
    N effective_radius = 0;  // R*, m: 1/R* = 1/R_i + 1/R_j
    N effective_mass = 0;    // m*, kg
    N inverse_cube_root = 0; // R*^(-1/3), m^(-1/3), which the JKR lengths need
};

template <class N = Real> struct NormalResponse {
    N force = 0;          // N, positive pushes apart
    N contact_radius = 0; // a, m
    N pull_off_force = 0; // F_C = 3 pi gamma R*, N, positive; 0 where the contact does not adhere
    MaskOf<N> touches = MaskOf<N>(false);
    N impedance = 0; // N s/m, sqrt(S_n m*), S_n = 2 E* a; times 2 sqrt(5/6) beta the dashpot's
};

} // namespace arenite
