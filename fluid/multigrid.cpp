// SPDX-License-Identifier: MIT
#include "fluid/multigrid.hpp"

#include <algorithm>
#include <limits>

namespace arenite {
namespace {

// Chebyshev polynomial of degree 2 on [low, high]; the Jacobi-scaled matrix has no eigenvalue above 2, and
// its eigenvalues below `low` are the coarse level's.
constexpr Real low = 0.35, high = 2;
constexpr Real centre = (high + low) / 2, radius = (high - low) / 2;
constexpr Real second_ratio = 1 / (2 * centre / radius - radius / centre);
constexpr Real momentum = second_ratio * radius / centre; // of the first step's correction in the second
constexpr Real second_step = 2 * second_ratio / radius;

/// Where a cell is. A host makes it once for a line of cells: integer divisions are what these loops would spend
/// their time on.
struct Place {
    int number;
    int c[3];
};

KOKKOS_FORCEINLINE_FUNCTION Place place_of(MultigridLevel const& level, int number)
{
    Place place{number, {}};
    level.cell_of(number, place.c);
    return place;
}

KOKKOS_FORCEINLINE_FUNCTION Place moved(Place place, int axis, int by, int stride)
{
    place.c[axis] += by;
    place.number += by * stride;
    return place;
}

/// body(Place) for every cell of a level.
template <class Body> void for_each_place(char const* label, MultigridLevel const& level_now, Body const& body)
{
    MultigridLevel const level = level_now;
    if (on_host)
        Kokkos::parallel_for(
            label, RangePolicy(0, level.cells[1] * level.cells[2]), KOKKOS_LAMBDA(int line) {
                Place place{line * level.cells[0], {0, line % level.cells[1], line / level.cells[1]}};
                for (; place.c[0] < level.cells[0]; ++place.c[0], ++place.number) body(place);
            });
    else
        Kokkos::parallel_for(
            label, RangePolicy(0, level.cell_count()), KOKKOS_LAMBDA(int cell) { body(place_of(level, cell)); });
}

/// Sum over the cell's faces of conductance * (value(cell) - value(neighbour)).
template <class Value>
KOKKOS_FORCEINLINE_FUNCTION Real row(MultigridLevel const& level, Place const& cell, Value const& value)
{
    Real const here = value(cell);
    Real sum = 0;
    int stride = 1; // to the next cell, and to the next face
    for (int axis = 0; axis < 3; ++axis) {
        int const n = level.cells[axis], at = cell.c[axis], face = level.face_number(axis, cell.c);
        Real const lower = level.conductance[axis](face), upper = level.conductance[axis](face + stride);
        Real below = 0, above = 0;
        if (at > 0) below = value(moved(cell, axis, -1, stride));
        else if (level.periodic[axis]) below = value(moved(cell, axis, n - 1, stride));
        if (at < n - 1) above = value(moved(cell, axis, 1, stride));
        else if (level.periodic[axis]) above = value(moved(cell, axis, 1 - n, stride));
        sum += lower * (here - below) + upper * (here - above);
        stride *= n;
    }
    return sum;
}

struct Stored { // a vector as a function of the cell
    View1<Real> const& vector;
    KOKKOS_FORCEINLINE_FUNCTION Real operator()(Place const& cell) const { return vector(cell.number); }
};

struct FirstStep { // the first Chebyshev step from 0, made where it is read
    View1<Real> const &right_hand_side, &inverse_diagonal;
    KOKKOS_FORCEINLINE_FUNCTION Real operator()(Place const& cell) const
    {
        return inverse_diagonal(cell.number) * right_hand_side(cell.number) / centre;
    }
};

KOKKOS_FORCEINLINE_FUNCTION int coarse_number(MultigridLevel const& fine, MultigridLevel const& coarse, Place const& cell)
{
    int c[3];
    for (int axis = 0; axis < 3; ++axis) c[axis] = cell.c[axis] >> (fine.ratio[axis] - 1); // the ratio is 1 or 2
    return coarse.number(c);
}

struct Prolonged { // the smoothed vector with the coarse level's correction
    MultigridLevel const &fine, &coarse;
    KOKKOS_FORCEINLINE_FUNCTION Real operator()(Place const& cell) const
    {
        return fine.smoothed(cell.number) + coarse.solution(coarse_number(fine, coarse, cell));
    }
};

// The parts of the cycle for one cell. b: the level's right-hand side; x: the cycle's answer to it.

KOKKOS_FORCEINLINE_FUNCTION void smooth_from_zero(MultigridLevel const& level, View1<Real> const& b, Place const& cell)
{
    FirstStep const first{b, level.inverse_diagonal};
    Real const residual = b(cell.number) - row(level, cell, first);
    level.smoothed(cell.number) =
        (1 + momentum) * first(cell) + second_step * level.inverse_diagonal(cell.number) * residual;
}

KOKKOS_FORCEINLINE_FUNCTION void restrict_residual(MultigridLevel const& fine, MultigridLevel const& coarse,
                                                   View1<Real> const& b, Place const& cell)
{
    int first[3], end[3];
    for (int axis = 0; axis < 3; ++axis) {
        first[axis] = cell.c[axis] * fine.ratio[axis];
        end[axis] = Kokkos::min(first[axis] + fine.ratio[axis], fine.cells[axis]);
    }
    Real sum = 0;
    for (int k = first[2]; k < end[2]; ++k)
        for (int j = first[1]; j < end[1]; ++j)
            for (int i = first[0]; i < end[0]; ++i) {
                Place const of{fine.number({i, j, k}), {i, j, k}};
                sum += b(of.number) - row(fine, of, Stored{fine.smoothed});
            }
    coarse.right_hand_side(cell.number) = sum;
}

KOKKOS_FORCEINLINE_FUNCTION void prolong_and_smooth(MultigridLevel const& fine, MultigridLevel const& coarse,
                                                    View1<Real> const& b, View1<Real> const& x, Place const& cell)
{
    Prolonged const start{fine, coarse};
    Real const residual = b(cell.number) - row(fine, cell, start);
    fine.correction(cell.number) = fine.inverse_diagonal(cell.number) * residual / centre;
    x(cell.number) = start(cell);
}

KOKKOS_FORCEINLINE_FUNCTION void smooth_again(MultigridLevel const& level, View1<Real> const& x, Place const& cell)
{
    // The residual after the first step, scaled by the diagonal, is centre * correction - D^-1 A correction.
    Real const first = level.correction(cell.number);
    Real const scaled = centre * first - level.inverse_diagonal(cell.number) * row(level, cell, Stored{level.correction});
    x(cell.number) += (1 + momentum) * first + second_step * scaled;
}

KOKKOS_FORCEINLINE_FUNCTION void solve_coarsest(MultigridLevel const& level, View1<Real> const& b, View1<Real> const& x,
                                                Place const& cell)
{
    x(cell.number) = level.inverse_diagonal(cell.number) * b(cell.number);
}

void descend(MultigridLevel const& fine_level, MultigridLevel const& coarse_level, View1<Real> const& b)
{
    MultigridLevel const fine = fine_level, coarse = coarse_level;
    for_each_place("smooth_from_zero", fine, KOKKOS_LAMBDA(Place const& cell) { smooth_from_zero(fine, b, cell); });
    for_each_place(
        "restrict_residual", coarse, KOKKOS_LAMBDA(Place const& cell) { restrict_residual(fine, coarse, b, cell); });
}

void ascend(MultigridLevel const& fine_level, MultigridLevel const& coarse_level, View1<Real> const& b, View1<Real> const& x)
{
    MultigridLevel const fine = fine_level, coarse = coarse_level;
    for_each_place(
        "prolong_and_smooth", fine, KOKKOS_LAMBDA(Place const& cell) { prolong_and_smooth(fine, coarse, b, x, cell); });
    for_each_place("smooth_again", fine, KOKKOS_LAMBDA(Place const& cell) { smooth_again(fine, x, cell); });
}

void solve_on_coarsest(MultigridLevel const& level_now, View1<Real> const& b, View1<Real> const& x)
{
    MultigridLevel const level = level_now;
    for_each_place("solve_coarsest", level, KOKKOS_LAMBDA(Place const& cell) { solve_coarsest(level, b, x, cell); });
}

/// The whole cycle over the last levels by one team of a device, with a barrier where larger levels have a launch: a launch
/// takes as long as some thousand cells.
struct SmallCycle {
    static constexpr int team = 512, most_levels = 12, most_cells = 2048;
    int levels = 0;
    MultigridLevel level[most_levels];
    View1<Real> b, x; // of the first of them

    KOKKOS_FUNCTION View1<Real> const& right_hand_side(int l) const { return l == 0 ? b : level[l].right_hand_side; }
    KOKKOS_FUNCTION View1<Real> const& solution(int l) const { return l == 0 ? x : level[l].solution; }

    KOKKOS_FUNCTION void operator()(TeamPolicy::member_type const& member) const
    {
        auto const each = [&](MultigridLevel const& of, auto const& body) {
            for (int cell = member.team_rank(); cell < of.cell_count(); cell += team) body(place_of(of, cell));
            member.team_barrier();
        };
        int const last = levels - 1;
        for (int l = 0; l < last; ++l) {
            each(level[l], [&](Place const& cell) { smooth_from_zero(level[l], right_hand_side(l), cell); });
            each(level[l + 1],
                 [&](Place const& cell) { restrict_residual(level[l], level[l + 1], right_hand_side(l), cell); });
        }
        each(level[last],
             [&](Place const& cell) { solve_coarsest(level[last], right_hand_side(last), solution(last), cell); });
        for (int l = last - 1; l >= 0; --l) {
            each(level[l], [&](Place const& cell) {
                prolong_and_smooth(level[l], level[l + 1], right_hand_side(l), solution(l), cell);
            });
            each(level[l], [&](Place const& cell) { smooth_again(level[l], solution(l), cell); });
        }
    }
};

/// From which level on a device does the rest at once; on a host only the coarsest, a single cell, is left.
std::size_t first_small_level(MultigridLevels const& levels)
{
    std::size_t first = levels.size() - 1;
    if (!on_host)
        while (first > 0 && levels[first - 1].cell_count() <= SmallCycle::most_cells &&
               levels.size() - first < SmallCycle::most_levels)
            --first;
    return first;
}

void cycle_small_levels(MultigridLevels const& levels, std::size_t first, View1<Real> const& b, View1<Real> const& x)
{
    SmallCycle cycle;
    for (std::size_t l = first; l < levels.size(); ++l) cycle.level[cycle.levels++] = levels[l];
    cycle.b = b;
    cycle.x = x;
    Kokkos::parallel_for("multigrid_cycle", TeamPolicy(1, SmallCycle::team), cycle);
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
                    for (int i = first[0]; i < end[0]; ++i) sum += fine.conductance[axis](fine.face_number(axis, {i, j, k}));
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
    for_each_place(
        "apply_conductances", level,
        KOKKOS_LAMBDA(Place const& cell) { image(cell.number) = row(level, cell, Stored{vector}); });
}

void multigrid_cycle(MultigridLevels const& levels, View1<Real> const& right_hand_side, View1<Real> const& result)
{
    std::size_t const small = first_small_level(levels);
    auto const b = [&](std::size_t l) { return l == 0 ? right_hand_side : levels[l].right_hand_side; };
    auto const x = [&](std::size_t l) { return l == 0 ? result : levels[l].solution; };
    for (std::size_t l = 0; l < small; ++l) descend(levels[l], levels[l + 1], b(l));
    if (on_host) solve_on_coarsest(levels[small], b(small), x(small));
    else cycle_small_levels(levels, small, b(small), x(small));
    for (std::size_t l = small; l-- > 0;) ascend(levels[l], levels[l + 1], b(l), x(l));
}

} // namespace arenite
