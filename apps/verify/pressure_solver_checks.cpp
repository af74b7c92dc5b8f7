// SPDX-License-Identifier: MIT
// Iterations of the multigrid-preconditioned pressure solver against the number of cells and the contrast of
// the coefficients.
#include "apps/verify/fluid_checks.hpp"
#include "apps/verify/pressure_problem.hpp"
#include "fluid/conjugate_gradients.hpp"
#include "fluid/multigrid.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace arenite {
namespace {

Grid grid_of(PressureProblem const& problem)
{
    Grid grid;
    for (int axis = 0; axis < 3; ++axis) {
        grid.cells[axis] = problem.cells[axis];
        grid.periodic[axis] = problem.ends == Ends::periodic;
    }
    return grid;
}

/// A face's drag is the mean of its cells' drags, so that its mobility is the harmonic mean of theirs.
void set_conductances(PressureProblem const& problem, MultigridLevel const& level)
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
            bool const open =
                problem.ends == Ends::open_all || (problem.ends == Ends::open_top && axis == 2 && above[axis] == n[axis]);
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

} // namespace

PressureSolve solve_pressure_problem(PressureProblem const& problem)
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

    apply_conductances(levels[0], v.solution, v.image); // the true residual, not the recurrence's
    auto const image = Kokkos::create_mirror_view(v.image);
    Kokkos::deep_copy(image, v.image);
    Real residual = 0, size = 0;
    for (int c = 0; c < cells; ++c) {
        residual += std::pow(rhs(c) - image(c), 2);
        size += std::pow(rhs(c), 2);
    }
    return {report.iterations, size > 0 ? std::sqrt(residual / size) : std::sqrt(residual), report.converged};
}

Mobility uniform_mobility()
{
    return [](int, int, int) { return Real(1); };
}

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

namespace {

/// 16^3, 32^3 and 64^3 cells; the gate is a growth below 1.3 a doubling.
void add_series(std::vector<VerifyCase>& rows, std::string const& name, std::function<PressureProblem(int)> const& problem)
{
    PressureSolve const coarse = solve_pressure_problem(problem(16)), fine = solve_pressure_problem(problem(32)),
                        finest = solve_pressure_problem(problem(64));
    std::string const source = "multigrid: independent of the grid";
    rows.push_back(at_most({name + ", 16^3", "iterations to 1e-8", source}, coarse.iterations, 20));
    rows.push_back(at_most({name + ", 32^3", "iterations to 1e-8", source}, fine.iterations, 20));
    rows.push_back(at_most({name + ", 64^3", "iterations to 1e-8", source}, finest.iterations, 20));
    rows.push_back(
        at_most({name, "growth of the iterations, 32^3 to 64^3", source}, Real(finest.iterations) / fine.iterations, 1.3));
    rows.push_back(compare_error({name + ", 64^3", "true residual / right-hand side", "solver"}, finest.residual, 2e-8));
}

} // namespace

std::vector<VerifyCase> check_pressure_solver()
{
    std::vector<VerifyCase> rows;
    add_series(rows, "F9 uniform mobility, closed box",
               [](int n) { return PressureProblem{{n, n, n}, Ends::closed, uniform_mobility()}; });
    for (Real const contrast : {1e2, 1e4, 1e6})
        add_series(rows, fmt::format("F9 cavity in a bed, contrast {:g}", contrast),
                   [=](int n) { return PressureProblem{{n, n, n}, Ends::open_top, cavity_in_bed(n, contrast)}; });
    return rows;
}

} // namespace arenite
