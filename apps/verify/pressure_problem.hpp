// SPDX-License-Identifier: MIT
// The pressure solver alone: boxes of cells whose mobility is given, every kind of boundary, a random right-hand
// side; how many iterations it takes.
#pragma once

#include "core/types.hpp"

#include <array>
#include <functional>

namespace arenite {

using Mobility = std::function<Real(int, int, int)>; // of a cell

enum class Ends { closed, open_top, open_all, periodic };

struct PressureProblem {
    std::array<int, 3> cells;
    Ends ends;
    Mobility mobility;
};

struct PressureSolve {
    int iterations = 0;
    Real residual = 0; // the true one, over the right-hand side
    bool converged = false;
};

/// To a residual of 1e-8 of the right-hand side.
PressureSolve solve_pressure_problem(PressureProblem const& problem);

Mobility uniform_mobility();

/// A bed of mobility 1/contrast with a cavity of mobility 1 along part of the axis, under a hole; n cells an edge.
Mobility cavity_in_bed(int n, Real contrast);

/// Blocks of 4^3 cells at random, touching along edges and at corners: harder than any bed.
Mobility random_blocks(Real contrast);

} // namespace arenite
