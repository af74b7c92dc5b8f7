// SPDX-License-Identifier: MIT
// Lid-driven cavity at Re 100 against its centre lines by other methods. `converge_cavity` has finer grids and Re 400,
// 1000.
#include "apps/verify/cavity_tables.hpp"
#include "apps/verify/fluid_case.hpp"
#include "apps/verify/fluid_checks.hpp"

namespace arenite {

std::vector<VerifyCase> check_cavity()
{
    std::vector<Cavity> const cavities = steady_cavities(100, {28, 56}, 1e-6);
    Cavity const &coarse = cavities[0], &fine = cavities[1];
    std::array<Real, 3> const low = coarse.extrema(), high = fine.extrema();
    std::array<Real, 3> const& reference = spectral_extrema_100;
    std::string const name = "F1 cavity, Re 100", ghia = "Ghia, Ghia & Shin 1982, table I",
                      other = "stream function-vorticity, Richardson", spectral = "Botella & Peyret 1998";
    std::vector<VerifyCase> rows{compare_error({name + ", 56^2", "largest error of u at 15 points / lid speed", other},
                                               largest_error(fine.u, vorticity_u_100), 5e-3),
                                 compare_error({name + ", 56^2", "largest error of v at 15 points / lid speed", other},
                                               largest_error(fine.v, vorticity_v_100), 5e-3),
                                 compare_error({name + ", 56^2", "largest error of u at 15 points / lid speed", ghia},
                                               largest_error(fine.u, ghia_u_100), 5e-3)};
    // Second order with a third-order part from the slope at the walls: 1.88 to 2.00 here.
    for (int e = 0; e < 3; ++e) {
        std::string const quantity = extremum_names[e];
        rows.push_back(at_least({name, "order of " + quantity + ", 28 to 56", spectral},
                                observed_order(std::fabs(low[e] - reference[e]), std::fabs(high[e] - reference[e])), 1.8));
        rows.push_back(compare({name + ", 28^2 and 56^2", quantity + ", Richardson", spectral}, (4 * high[e] - low[e]) / 3,
                               reference[e], 1e-3));
    }
    constexpr Real at = 0.8594; // where Ghia's table has -0.22445
    rows.push_back(compare({name + ", 28^2 and 56^2", "v at x = 0.8594, Richardson (Ghia's table: -0.22445)", other},
                           (4 * fine.v(at) - coarse.v(at)) / 3, -0.23371, 5e-3));
    rows.push_back(compare_error({name, "flow through the walls", "closed box"}, coarse.leak + fine.leak, 0));
    rows.push_back(expect_true({name, "every solve converged", "solver"}, coarse.converged && fine.converged));
    return rows;
}

} // namespace arenite
