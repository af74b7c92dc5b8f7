// SPDX-License-Identifier: MIT
// The lid-driven cavity (F1 beyond `arenite verify fluid`): the steady state is reached, its extrema converge with
// second order to those of another method, and its centre lines lie on the tables. Cavity takes seconds; CavityGates,
// on 128^2 and finer, minutes.
#include "apps/verify/cavity_tables.hpp"

#include <gtest/gtest.h>

#include <cstdio>

using namespace arenite;

namespace {

constexpr Real gate = 1e-3; // of an extrapolated extremum

/// A quantity of second order on two grids, the second `ratio` times as fine: what it is without that part of the error
/// (Richardson).
Real extrapolate(Real coarse, Real fine, Real ratio) { return (ratio * ratio * fine - coarse) / (ratio * ratio - 1); }

/// Twice so, each grid twice as fine as the one before: without the third-order part either.
Real extrapolate_twice(Real coarse, Real middle, Real fine)
{
    return (8 * extrapolate(middle, fine, 2) - extrapolate(coarse, middle, 2)) / 7;
}

Real relative_error(Real value, Real reference) { return std::fabs(value / reference - 1); }

/// Steady flows on these grids. From the last two of them come the order and the extrapolated extrema, which must be within
/// `limit` of these.
std::vector<Cavity> check(Real reynolds, std::vector<int> const& cells, std::array<Real, 3> const& extrema, Real limit)
{
    constexpr Real least_order = 1.8;
    // Leaves at most 20 times this to go: at Re 1000 the slowest mode falls by 6 % in a unit of time.
    constexpr Real still = 1e-6;
    std::vector<Cavity> const cavities = steady_cavities(reynolds, cells, still);
    for (std::size_t grid = 0; grid < cells.size(); ++grid) {
        std::printf("Re %g, %d^2: steady to %.1e after %d units of time\n", reynolds, cells[grid], cavities[grid].change,
                    cavities[grid].duration);
        EXPECT_TRUE(cavities[grid].converged);
        EXPECT_LT(cavities[grid].change, still);
    }
    Real const ratio = Real(cells.back()) / cells[cells.size() - 2];
    std::array<Real, 3> const coarse = cavities[cavities.size() - 2].extrema(), fine = cavities.back().extrema();
    for (int e = 0; e < 3; ++e) {
        Real const order = std::log((coarse[e] - extrema[e]) / (fine[e] - extrema[e])) / std::log(ratio);
        Real const error = relative_error(extrapolate(coarse[e], fine[e], ratio), extrema[e]);
        std::printf("Re %g, %s: %.6f, %.6f, reference %.6f, order %.2f, extrapolated off by %.3f %%\n", reynolds,
                    extremum_names[e], coarse[e], fine[e], extrema[e], order, 100 * error);
        EXPECT_GT(order, least_order);
        EXPECT_LT(error, limit);
    }
    return cavities;
}

/// On 32^2, 64^2, 128^2 and those of `finer`; the one on 128^2.
Cavity check_gates(Real reynolds, std::array<Real, 3> const& extrema, std::vector<int> const& finer = {})
{
    std::vector<int> cells{32, 64, 128};
    cells.insert(cells.end(), finer.begin(), finer.end());
    std::vector<Cavity> const c = check(reynolds, cells, extrema, gate);
    std::array<Real, 3> const coarse = c[0].extrema(), middle = c[1].extrema(), fine = c[2].extrema();
    for (int e = 0; e < 3; ++e) {
        Real const error = relative_error(extrapolate_twice(coarse[e], middle[e], fine[e]), extrema[e]);
        std::printf("Re %g, %s: %.6f on 32^2; extrapolated from three grids off by %.3f %%\n", reynolds, extremum_names[e],
                    coarse[e], 100 * error);
        EXPECT_LT(error, gate);
    }
    return c[2];
}

template <std::size_t n>
void check_points(char const* name, Profile const& profile, CenterLinePoint const (&points)[n], Real limit)
{
    Real const error = largest_error(profile, points);
    std::printf("%s: largest difference %.2f %% of the lid's speed\n", name, 100 * error);
    EXPECT_LT(error, limit);
}

// The gate is one of 64 and 128 cells; of grids twice as coarse a remainder of second order is 4 times as large.
TEST(Cavity, Re400)
{
    Cavity const fine = check(400, {32, 64}, vorticity_extrema_400, 4 * gate).back();
    check_points("u, Ghia", fine.u, ghia_u_400, 0.01);
    check_points("v, Ghia", fine.v, ghia_v_400, 0.01);
}

TEST(CavityGates, Re100)
{
    Cavity const fine = check_gates(100, spectral_extrema_100);
    check_points("u, other method", fine.u, vorticity_u_100, 0.005);
    check_points("v, other method", fine.v, vorticity_v_100, 0.005);
    check_points("u, Ghia", fine.u, ghia_u_100, 0.005);
}

// A finer grid comes no nearer to the table's v: 0.66 % on 64^2, 0.59 % on 128^2.
TEST(CavityGates, Re400)
{
    Cavity const fine = check_gates(400, vorticity_extrema_400);
    check_points("u, Ghia", fine.u, ghia_u_400, 0.01);
    check_points("v, Ghia", fine.v, ghia_v_400, 0.01);
}

// The boundary layers are thinner, the third-order part is larger: extrapolated from 64^2 and 128^2 extrema are
// off by 0.109 %.
TEST(CavityGates, Re1000)
{
    Cavity const fine = check_gates(1000, spectral_extrema_1000, {160});
    check_points("u, Ghia", fine.u, ghia_u_1000, 0.02);
    check_points("v, Ghia", fine.v, ghia_v_1000, 0.02);
}

} // namespace
