// SPDX-License-Identifier: MIT
// Iterations of the multigrid-preconditioned pressure solver against the number of cells, the contrast of
// the coefficients, odd sizes, thin boxes and every kind of boundary.
#include "fluid/conjugate_gradients.hpp"
#include "fluid/multigrid.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>

using namespace arenite;

namespace
{

using Mobility = std::function<Real(int, int, int)>; // of a cell

enum class Ends { closed, open_top, open_all, periodic };

struct Problem {
    std::array<int, 3> cells;
    Ends ends;
    Mobility mobility;
};

Grid grid_of(Problem const& problem)
{
    Grid grid;
    for (int axis = 0; axis < 3; ++axis) {
        grid.cells[axis] = problem.cells[axis];
        grid.periodic[axis] = problem.ends == Ends::periodic;
    }
    return grid;
}

/// A face's drag is the mean of its cells' drags, so that its mobility is the harmonic mean of theirs.
void set_conductances(Problem const& problem, MultigridLevel const& level)
{
    auto const& n = problem.cells;
    for (int axis = 0; axis < 3; ++axis) {
        auto const host = Kokkos::create_mirror_view(level.conductance[axis]);
        for (int f = 0; f < level.face_count(axis); ++f) {
            int const nx = n[0] + (axis == 0), ny = n[1] + (axis == 1);
            std::array<int, 3> above{f % nx, f / nx % ny, f / nx / ny}, below = above;
            below[axis] -= 1;
            bool const boundary = below[axis] < 0 || above[axis] == n[axis];
            if (problem.ends == Ends::periodic) {
                below[axis] = (below[axis] + n[axis]) % n[axis];
                above[axis] = above[axis] % n[axis];
            }
            bool const open = problem.ends == Ends::open_all ||
                              (problem.ends == Ends::open_top && axis == 2 && above[axis] == n[axis]);
            if (boundary && problem.ends != Ends::periodic) {
                auto const inside = below[axis] < 0 ? above : below;
                host(f) = open ? 2 * problem.mobility(inside[0], inside[1], inside[2]) : 0;
            } else {
                bool const self = n[axis] == 1;
                host(f) = self ? 0
                               : 2 / (1 / problem.mobility(above[0], above[1], above[2]) +
                                      1 / problem.mobility(below[0], below[1], below[2]));
            }
        }
        Kokkos::deep_copy(level.conductance[axis], host);
    }
}

Real noise(std::uint64_t n) // a fixed sequence in (-1, 1)
{
    n = (n + 1) * 0x9E3779B97F4A7C15ull;
    n = (n ^ (n >> 30)) * 0xBF58476D1CE4E5B9ull;
    n = (n ^ (n >> 27)) * 0x94D049BB133111EBull;
    return Real((n ^ (n >> 31)) >> 11) / Real(1ull << 52) - 1;
}

int iterations_of(Problem const& problem)
{
    MultigridLevels const levels = make_multigrid(grid_of(problem));
    set_conductances(problem, levels[0]);
    update_multigrid(levels);
    int const cells = levels[0].cell_count();
    KrylovVectors const v = make_krylov_vectors(cells);
    auto const rhs = Kokkos::create_mirror(v.residual); // a copy: the solve overwrites the residual
    Real mean = 0;
    for (int c = 0; c < cells; ++c) mean += (rhs(c) = noise(c)) / cells;
    bool const singular = problem.ends == Ends::closed || problem.ends == Ends::periodic;
    for (int c = 0; c < cells; ++c) rhs(c) -= singular ? mean : 0;
    Kokkos::deep_copy(v.residual, rhs);

    SumWorkspace sums;
    KrylovReport const report = solve_by_conjugate_gradients(
        v, {1e-8, 0, 200}, sums, [&](auto const& x, auto const& y) { apply_conductances(levels[0], x, y); },
        [&](auto const& r, auto const& z) { multigrid_cycle(levels, r, z); });
    EXPECT_TRUE(report.converged);

    apply_conductances(levels[0], v.solution, v.image); // the true residual, not the recurrence's
    auto const image = Kokkos::create_mirror_view(v.image);
    Kokkos::deep_copy(image, v.image);
    Real residual = 0, size = 0;
    for (int c = 0; c < cells; ++c) {
        residual += std::pow(rhs(c) - image(c), 2);
        size += std::pow(rhs(c), 2);
    }
    EXPECT_LE(std::sqrt(residual), 2e-8 * std::sqrt(size));
    return report.iterations;
}

Mobility uniform()
{
    return [](int, int, int) { return Real(1); };
}

/// A bed of mobility 1e-6 with a cavity of mobility 1 along part of the axis, under a hole.
Mobility cavity_in_bed(int n, Real contrast)
{
    return [=](int i, int j, int k) {
        Real const x = (i + 0.5) / n - 0.5, y = (j + 0.5) / n - 0.5, z = (k + 0.5) / n;
        return x * x + y * y < 0.0144 && z > 0.3 ? Real(1) : 1 / contrast;
    };
}

Mobility random_blocks(Real contrast)
{
    return [=](int i, int j, int k) {
        return noise(i / 4 + 1000 * (j / 4) + 1000000 * std::uint64_t(k / 4)) > 0 ? Real(1) : 1 / contrast;
    };
}

TEST(PressureSolver, IterationsDoNotGrowWithTheGrid)
{
    for (Ends const ends : {Ends::closed, Ends::open_top, Ends::open_all, Ends::periodic}) {
        int counts[3], at = 0;
        for (int const n : {16, 32, 64}) counts[at++] = iterations_of({{n, n, n}, ends, uniform()});
        printf("uniform, ends %d: %d %d %d\n", int(ends), counts[0], counts[1], counts[2]);
        EXPECT_LE(counts[2], 1.3 * counts[1]);
        EXPECT_LE(counts[2], 20);
    }
}

TEST(PressureSolver, IterationsDoNotGrowWithACavityInABed)
{
    for (Ends const ends : {Ends::closed, Ends::open_top}) {
        int counts[3], at = 0;
        for (int const n : {16, 32, 64}) counts[at++] = iterations_of({{n, n, n}, ends, cavity_in_bed(n, 1e6)});
        printf("cavity 1e6, ends %d: %d %d %d\n", int(ends), counts[0], counts[1], counts[2]);
        EXPECT_LE(counts[2], 1.3 * counts[1]);
        EXPECT_LE(counts[2], 20);
    }
}

// Harder than any bed: blocks of 4^3 cells at random, touching along edges and at corners. A preconditioner
// that copies to the coarse cells grows here with the contrast; it has to converge, no more.
TEST(PressureSolver, RandomBlocksConverge)
{
    EXPECT_LE(iterations_of({{32, 32, 32}, Ends::open_top, random_blocks(1e2)}), 30);
    EXPECT_LE(iterations_of({{32, 32, 32}, Ends::open_top, random_blocks(1e6)}), 100);
}

TEST(PressureSolver, AnyNumberOfCells)
{
    for (Ends const ends : {Ends::closed, Ends::open_top, Ends::periodic})
        for (auto const cells :
             {std::array{12, 12, 6}, std::array{13, 7, 5}, std::array{1, 1, 40}, std::array{33, 1, 17},
              std::array{3, 3, 3}, std::array{2, 1, 1}, std::array{1, 1, 1}}) {
            int const count = iterations_of({cells, ends, uniform()});
            printf("%d x %d x %d, ends %d: %d\n", cells[0], cells[1], cells[2], int(ends), count);
            EXPECT_LE(count, 20);
        }
}

} // namespace
