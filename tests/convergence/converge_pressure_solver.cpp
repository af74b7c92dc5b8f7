// SPDX-License-Identifier: MIT
// The pressure solver beyond `arenite verify fluid`: 128^3 cells, every kind of boundary, odd sizes, thin boxes.
#include "apps/verify/pressure_problem.hpp"

#include <gtest/gtest.h>

using namespace arenite;

namespace {

int iterations_of(PressureProblem const& problem)
{
    PressureSolve const solve = solve_pressure_problem(problem);
    EXPECT_TRUE(solve.converged);
    EXPECT_LE(solve.residual, 2e-8);
    return solve.iterations;
}

TEST(PressureSolver, IterationsDoNotGrowWithTheGrid)
{
    for (Ends const ends : {Ends::open_top, Ends::open_all, Ends::periodic}) {
        int counts[3], at = 0;
        for (int const n : {16, 32, 64}) counts[at++] = iterations_of({{n, n, n}, ends, uniform_mobility()});
        printf("uniform, ends %d: %d %d %d\n", int(ends), counts[0], counts[1], counts[2]);
        EXPECT_LE(counts[2], 1.3 * counts[1]);
        EXPECT_LE(counts[2], 20);
    }
}

TEST(PressureSolver, IterationsDoNotGrowFrom64To128)
{
    int counts[2], at = 0;
    for (int const n : {64, 128}) counts[at++] = iterations_of({{n, n, n}, Ends::open_top, cavity_in_bed(n, 1e6)});
    printf("cavity 1e6: %d %d\n", counts[0], counts[1]);
    EXPECT_LE(counts[1], 1.3 * counts[0]);
    EXPECT_LE(counts[1], 20);
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
        for (auto const cells : {std::array{12, 12, 6}, std::array{13, 7, 5}, std::array{1, 1, 40}, std::array{33, 1, 17},
                                 std::array{3, 3, 3}, std::array{2, 1, 1}, std::array{1, 1, 1}}) {
            int const count = iterations_of({cells, ends, uniform_mobility()});
            printf("%d x %d x %d, ends %d: %d\n", cells[0], cells[1], cells[2], int(ends), count);
            EXPECT_LE(count, 20);
        }
}

} // namespace
