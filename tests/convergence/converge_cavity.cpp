// SPDX-License-Identifier: MIT
// The lid-driven cavity at Re 400 (F1 beyond `arenite verify fluid`): the steady state is reached, its extrema converge with
// second order to those of another method, and its centre lines lie on the tables of Ghia, Ghia & Shin 1982.
#include "apps/verify/cavity_flow.hpp"

#include <gtest/gtest.h>

#include <cstdio>

using namespace arenite;

namespace
{

// Without v at x = 0.9063 for Re 400, -0.23827: a misprint, out of line with its neighbours.
constexpr CenterLinePoint ghia_u_400[] = {
    {0.0547, -0.08186}, {0.0625, -0.09266}, {0.0703, -0.10338}, {0.1016, -0.14612}, {0.1719, -0.24299},
    {0.2813, -0.32726}, {0.4531, -0.17119}, {0.5, -0.11477}, {0.6172, 0.02135}, {0.7344, 0.16256},
    {0.8516, 0.29093}, {0.9531, 0.55892}, {0.9609, 0.61756}, {0.9688, 0.68439}, {0.9766, 0.75837}};
constexpr CenterLinePoint ghia_v_400[] = {
    {0.0625, 0.18360}, {0.0703, 0.19713}, {0.0781, 0.20920}, {0.0938, 0.22965}, {0.1563, 0.28124},
    {0.2266, 0.30203}, {0.2344, 0.30174}, {0.5, 0.05186}, {0.8047, -0.38598}, {0.8594, -0.44993},
    {0.9453, -0.22847}, {0.9531, -0.19254}, {0.9609, -0.15663}, {0.9688, -0.12146}};
struct Reference {
    char const* name;
    Real value;
};

/// The last two of the grids, and what they are compared with: extrema as Cavity::extrema gives them.
void check(Real reynolds, std::vector<int> const& cells, Reference const (&extrema)[3], Real least_order,
           Real extrapolated_error, void (*centre_lines)(Cavity const&))
{
    constexpr Real still = 1e-5; // leaves some 4 times this to go, since the slowest mode falls by a quarter in a unit
    std::vector<Cavity> const cavities = steady_cavities(reynolds, cells, still);
    for (std::size_t grid = 0; grid < cells.size(); ++grid) {
        std::printf("Re %g, %d^2: steady to %.1e after %.0f\n", reynolds, cells[grid], cavities[grid].change,
                    cavities[grid].duration);
        EXPECT_TRUE(cavities[grid].converged);
        EXPECT_LT(cavities[grid].change, still);
    }
    Cavity const& fine = cavities.back();
    std::array<Real, 3> const low = cavities[cavities.size() - 2].extrema(), high = fine.extrema();
    for (int e = 0; e < 3; ++e) {
        Real const reference = extrema[e].value, extrapolated = (4 * high[e] - low[e]) / 3;
        Real const order = std::log2((low[e] - reference) / (high[e] - reference));
        std::printf("Re %g, %s: %.5f, %.5f, extrapolated %.5f, reference %.5f, order %.2f\n", reynolds,
                    extrema[e].name, low[e], high[e], extrapolated, reference, order);
        EXPECT_GT(order, least_order);
        EXPECT_LT(std::fabs(extrapolated / reference - 1), extrapolated_error);
    }
    centre_lines(fine);
}

// The gate of 0.1 % is one of 64 and 128 cells; of grids twice as coarse a remainder of second order is 4 times as large.
// The extrema are those of stream function and vorticity with 64 and 128 cells, extrapolated.
TEST(Cavity, Re400)
{
    check(400, {32, 64}, {{"u_min", -0.3287899}, {"v_max", 0.3039172}, {"v_min", -0.4542566}}, 1.8, 4e-3,
          [](Cavity const& cavity) {
              Real const u = largest_error(cavity.u, ghia_u_400), v = largest_error(cavity.v, ghia_v_400);
              std::printf("largest differences from the tables: u %.4f, v %.4f of the lid's speed\n", u, v);
              EXPECT_LT(u, 0.01);
              EXPECT_LT(v, 0.01);
          });
}

} // namespace
