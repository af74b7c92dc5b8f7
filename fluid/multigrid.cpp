// SPDX-License-Identifier: MIT
#include "fluid/multigrid.hpp"

#include <algorithm>
#include <limits>

namespace arenite
{
namespace
{

// Chebyshev polynomial of degree 2 on [low, high]; the Jacobi-scaled matrix has no eigenvalue above 2, and
// its eigenvalues below `low` are the coarse level's.
constexpr Real low = 0.35, high = 2;
constexpr Real centre = (high + low) / 2, radius = (high - low) / 2;
constexpr Real second_ratio = 1 / (2 * centre / radius - radius / centre);
constexpr Real momentum = second_ratio * radius / centre; // of the first step's correction in the second
constexpr Real second_step = 2 * second_ratio / radius;

/// Sum over the cell's faces of conductance * (value(cell) - value(neighbour)).
template <class Value> KOKKOS_INLINE_FUNCTION Real row(MultigridLevel const& level, int cell, Value const& value)
{
    int c[3];
    level.cell_of(cell, c);
    Real const here = value(cell);
    Real sum = 0;
    int stride = 1;
    for (int axis = 0; axis < 3; ++axis) {
        int const n = level.cells[axis];
        int f[3] = {c[0], c[1], c[2]};
        Real const lower = level.conductance[axis](level.face_number(axis, f));
        ++f[axis];
        Real const upper = level.conductance[axis](level.face_number(axis, f));
        Real below = 0, above = 0;
        if (c[axis] > 0) below = value(cell - stride);
        else if (level.periodic[axis]) below = value(cell + (n - 1) * stride);
        if (c[axis] < n - 1) above = value(cell + stride);
        else if (level.periodic[axis]) above = value(cell - (n - 1) * stride);
        sum += lower * (here - below) + upper * (here - above);
        stride *= n;
    }
    return sum;
}

struct Stored { // a vector as a function of the cell
    View1<Real> vector;
    KOKKOS_FUNCTION Real operator()(int cell) const { return vector(cell); }
};

struct FirstStep { // the first Chebyshev step from 0, made where it is read
    View1<Real> right_hand_side, inverse_diagonal;
    KOKKOS_FUNCTION Real operator()(int cell) const { return inverse_diagonal(cell) * right_hand_side(cell) / centre; }
};

KOKKOS_INLINE_FUNCTION int coarse_number(MultigridLevel const& fine, MultigridLevel const& coarse, int cell)
{
    int c[3];
    fine.cell_of(cell, c);
    for (int axis = 0; axis < 3; ++axis) c[axis] /= fine.ratio[axis];
    return coarse.number(c);
}

struct Prolonged { // the smoothed vector with the coarse level's correction
    MultigridLevel fine, coarse;
    View1<Real> vector;
    KOKKOS_FUNCTION Real operator()(int cell) const
    {
        return vector(cell) + coarse.solution(coarse_number(fine, coarse, cell));
    }
};

void smooth_from_zero(MultigridLevel const& level, View1<Real> const& b, View1<Real> const& x)
{
    FirstStep const first{b, level.inverse_diagonal};
    MultigridLevel const here = level;
    Kokkos::parallel_for(
        "smooth_from_zero", RangePolicy(0, level.cell_count()), KOKKOS_LAMBDA(int cell) {
            Real const residual = b(cell) - row(here, cell, first);
            x(cell) = (1 + momentum) * first(cell) + second_step * here.inverse_diagonal(cell) * residual;
        });
}

void restrict_residual(MultigridLevel const& fine_level, MultigridLevel const& coarse_level, View1<Real> const& b)
{
    MultigridLevel const fine = fine_level, coarse = coarse_level;
    Stored const x{fine.smoothed};
    Kokkos::parallel_for(
        "restrict_residual", RangePolicy(0, coarse.cell_count()), KOKKOS_LAMBDA(int number) {
            int first[3], end[3];
            coarse.cell_of(number, first);
            for (int axis = 0; axis < 3; ++axis) {
                first[axis] *= fine.ratio[axis];
                end[axis] = Kokkos::min(first[axis] + fine.ratio[axis], fine.cells[axis]);
            }
            Real sum = 0;
            for (int k = first[2]; k < end[2]; ++k)
                for (int j = first[1]; j < end[1]; ++j)
                    for (int i = first[0]; i < end[0]; ++i) {
                        int const cell = fine.number({i, j, k});
                        sum += b(cell) - row(fine, cell, x);
                    }
            coarse.right_hand_side(number) = sum;
        });
}

void prolong_and_smooth(MultigridLevel const& fine, MultigridLevel const& coarse, View1<Real> const& b,
                        View1<Real> const& result)
{
    Prolonged const start{fine, coarse, fine.smoothed};
    MultigridLevel const here = fine;
    Kokkos::parallel_for(
        "prolong_and_smooth", RangePolicy(0, fine.cell_count()), KOKKOS_LAMBDA(int cell) {
            Real const residual = b(cell) - row(here, cell, start);
            here.correction(cell) = here.inverse_diagonal(cell) * residual / centre;
            result(cell) = start(cell);
        });
    Stored const correction{fine.correction};
    Kokkos::parallel_for(
        "smooth_again", RangePolicy(0, fine.cell_count()), KOKKOS_LAMBDA(int cell) {
            // The residual after the first step, scaled by the diagonal, is centre * correction - D^-1 A correction.
            Real const first = correction(cell);
            Real const scaled = centre * first - here.inverse_diagonal(cell) * row(here, cell, correction);
            result(cell) += (1 + momentum) * first + second_step * scaled;
        });
}

void solve_coarsest(MultigridLevel const& level, View1<Real> const& b, View1<Real> const& x)
{
    View1<Real> const inverse_diagonal = level.inverse_diagonal;
    Kokkos::parallel_for(
        "solve_coarsest", RangePolicy(0, level.cell_count()),
        KOKKOS_LAMBDA(int cell) { x(cell) = inverse_diagonal(cell) * b(cell); });
}

/// Number of fine cells of a coarse cell along an axis; 0 beyond the boundary.
KOKKOS_INLINE_FUNCTION int width(MultigridLevel const& fine, int axis, int coarse_cell, int coarse_cells)
{
    if (fine.periodic[axis]) coarse_cell = (coarse_cell + coarse_cells) % coarse_cells;
    if (coarse_cell < 0 || coarse_cell >= coarse_cells) return 0;
    return Kokkos::min(fine.ratio[axis], fine.cells[axis] - coarse_cell * fine.ratio[axis]);
}

/// Conductance between coarse cells: the sum over the fine faces between them, less by the ratio of the
/// distances between centres (the sum alone, Galerkin's for a copying prolongation, is too stiff by it).
void coarsen_conductance(MultigridLevel const& fine_level, MultigridLevel const& coarse_level, int axis)
{
    MultigridLevel const fine = fine_level, coarse = coarse_level;
    Kokkos::parallel_for(
        "coarsen_conductance", RangePolicy(0, coarse.face_count(axis)), KOKKOS_LAMBDA(int number) {
            int const nx = coarse.cells[0] + (axis == 0), ny = coarse.cells[1] + (axis == 1);
            int const face[3] = {number % nx, number / nx % ny, number / nx / ny};
            int const n = coarse.cells[axis];
            int const below = width(fine, axis, face[axis] - 1, n), above = width(fine, axis, face[axis], n);
            int first[3], end[3];
            for (int d = 0; d < 3; ++d) {
                first[d] = d == axis ? Kokkos::min(face[d] * fine.ratio[d], fine.cells[d]) : face[d] * fine.ratio[d];
                end[d] = d == axis ? first[d] + 1 : Kokkos::min(first[d] + fine.ratio[d], fine.cells[d]);
            }
            Real sum = 0;
            for (int k = first[2]; k < end[2]; ++k)
                for (int j = first[1]; j < end[1]; ++j)
                    for (int i = first[0]; i < end[0]; ++i)
                        sum += fine.conductance[axis](fine.face_number(axis, {i, j, k}));
            Real const distance = below > 0 && above > 0 ? Real(0.5) * (below + above) : Real(below + above);
            bool const self = n == 1 && coarse.periodic[axis]; // a cell that is its own neighbour
            coarse.conductance[axis](number) = self ? 0 : sum / distance;
        });
}

void invert_diagonal(MultigridLevel const& level_now)
{
    MultigridLevel const level = level_now;
    Kokkos::parallel_for(
        "invert_diagonal", RangePolicy(0, level.cell_count()), KOKKOS_LAMBDA(int cell) {
            int c[3];
            level.cell_of(cell, c);
            Real diagonal = 0;
            for (int axis = 0; axis < 3; ++axis) {
                int f[3] = {c[0], c[1], c[2]};
                diagonal += level.conductance[axis](level.face_number(axis, f));
                ++f[axis];
                diagonal += level.conductance[axis](level.face_number(axis, f));
            }
            level.inverse_diagonal(cell) = diagonal > 0 ? 1 / diagonal : 0;
        });
}

void allocate(MultigridLevel& level)
{
    int const n = level.cell_count();
    for (int axis = 0; axis < 3; ++axis) level.conductance[axis] = View1<Real>("conductance", level.face_count(axis));
    for (View1<Real>* vector :
         {&level.inverse_diagonal, &level.right_hand_side, &level.solution, &level.smoothed, &level.correction})
        *vector = View1<Real>("multigrid_vector", n);
}

} // namespace

MultigridLevels make_multigrid(Grid const& grid)
{
    MultigridLevels levels(1);
    Vec3 spacing = grid.spacing;
    for (int axis = 0; axis < 3; ++axis) {
        levels[0].cells[axis] = grid.cells[axis];
        levels[0].periodic[axis] = grid.periodic[axis];
    }
    allocate(levels[0]);
    while (levels.back().cell_count() > 1) {
        MultigridLevel& fine = levels.back();
        Real smallest = std::numeric_limits<Real>::max();
        for (int axis = 0; axis < 3; ++axis)
            if (fine.cells[axis] > 1) smallest = std::min(smallest, spacing[axis]);
        MultigridLevel coarse;
        for (int axis = 0; axis < 3; ++axis) {
            if (fine.cells[axis] > 1 && spacing[axis] < Real(1.5) * smallest) fine.ratio[axis] = 2;
            spacing[axis] *= fine.ratio[axis];
            coarse.cells[axis] = (fine.cells[axis] + fine.ratio[axis] - 1) / fine.ratio[axis];
            coarse.periodic[axis] = fine.periodic[axis];
        }
        allocate(coarse);
        levels.push_back(coarse);
    }
    return levels;
}

void update_multigrid(MultigridLevels const& levels)
{
    invert_diagonal(levels[0]);
    for (std::size_t l = 1; l < levels.size(); ++l) {
        for (int axis = 0; axis < 3; ++axis) coarsen_conductance(levels[l - 1], levels[l], axis);
        invert_diagonal(levels[l]);
    }
}

void apply_conductances(MultigridLevel const& level_now, View1<Real> const& vector, View1<Real> const& image)
{
    MultigridLevel const level = level_now;
    Stored const x{vector};
    Kokkos::parallel_for(
        "apply_conductances", RangePolicy(0, level.cell_count()),
        KOKKOS_LAMBDA(int cell) { image(cell) = row(level, cell, x); });
}

void multigrid_cycle(MultigridLevels const& levels, View1<Real> const& right_hand_side, View1<Real> const& result)
{
    int const coarsest = static_cast<int>(levels.size()) - 1;
    auto const b = [&](int l) { return l == 0 ? right_hand_side : levels[l].right_hand_side; };
    auto const x = [&](int l) { return l == 0 ? result : levels[l].solution; };
    for (int l = 0; l < coarsest; ++l) {
        smooth_from_zero(levels[l], b(l), levels[l].smoothed);
        restrict_residual(levels[l], levels[l + 1], b(l));
    }
    solve_coarsest(levels[coarsest], b(coarsest), x(coarsest));
    for (int l = coarsest - 1; l >= 0; --l) prolong_and_smooth(levels[l], levels[l + 1], b(l), x(l));
}

} // namespace arenite
