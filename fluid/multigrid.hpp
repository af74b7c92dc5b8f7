// SPDX-License-Identifier: MIT
// Geometric multigrid for  sum over faces of conductance * (x - x_neighbour) = b  on a box of cells: the
// preconditioner of the pressure solve. A conductance on a boundary face joins the cell to a fixed 0.
//
// Any number of cells: an odd one leaves a last coarse cell of one fine cell. Only the axes with the
// smaller spacings are coarsened. Restriction adds the fine residuals, prolongation copies (its adjoint);
// a coarse conductance is that of the fine resistances in series along each line and in parallel over the
// lines, which holds for jumps of any size. Smoother: Chebyshev polynomial of degree 2 in the
// Jacobi-scaled matrix, the same before and after, so that the cycle is symmetric and its bits do not
// depend on the order of the cells. The coarsest level is one cell.
#pragma once

#include "core/grid.hpp"

#include <vector>

namespace arenite {

struct MultigridLevel {
    int cells[3] = {1, 1, 1};
    int ratio[3] = {1, 1, 1}; // fine cells per cell of the next coarser level
    bool periodic[3] = {false, false, false};
    View1<Real> conductance[3];       // [face], x fastest, one more face than cells along its axis
    View1<Real> inverse_diagonal;     // [cell], 0 where the row is empty
    View1<Real> right_hand_side;      // [cell]
    View1<Real> solution;             // [cell]
    View1<Real> smoothed, correction; // [cell], between the two steps of a smoothing

    KOKKOS_FUNCTION int cell_count() const { return cells[0] * cells[1] * cells[2]; }
    KOKKOS_FUNCTION int number(int const (&c)[3]) const { return c[0] + cells[0] * (c[1] + cells[1] * c[2]); }
    KOKKOS_FUNCTION void cell_of(int number, int (&c)[3]) const
    {
        c[0] = number % cells[0];
        c[1] = number / cells[0] % cells[1];
        c[2] = number / cells[0] / cells[1];
    }
    KOKKOS_FUNCTION int face_number(int axis, int const (&f)[3]) const
    {
        int const nx = cells[0] + (axis == 0), ny = cells[1] + (axis == 1);
        return f[0] + nx * (f[1] + ny * f[2]);
    }
    KOKKOS_FUNCTION int face_count(int axis) const { return cell_count() / cells[axis] * (cells[axis] + 1); }
};

using MultigridLevels = std::vector<MultigridLevel>;

MultigridLevels make_multigrid(Grid const& grid);

/// Coarse conductances and all diagonals from levels[0].conductance.
void update_multigrid(MultigridLevels const& levels);

/// image = matrix * vector on the finest level.
void apply_conductances(MultigridLevel const& level, View1<Real> const& vector, View1<Real> const& image);

/// result = one V-cycle on the right-hand side, from 0.
void multigrid_cycle(MultigridLevels const& levels, View1<Real> const& right_hand_side, View1<Real> const& result);

} // namespace arenite
