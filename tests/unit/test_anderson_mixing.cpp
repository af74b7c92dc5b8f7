// SPDX-License-Identifier: MIT
#include "apps/verify/anderson_mixing.hpp"

#include <gtest/gtest.h>

using namespace arenite;

namespace {

// Of n unknowns, a linear map needs n differences. Repeating this one would take 1e4 evaluations: its slowest mode falls by
// 0.1 % in one, and two more turn about each other.
TEST(AndersonMixing, FindsFixedPointOfLinearMapInAsManyDifferencesAsUnknowns)
{
    std::vector<Real> const fixed{3, -2, 0.5};
    auto const map = [&](std::vector<Real> const& x) {
        Real const a = x[0] - fixed[0], b = x[1] - fixed[1], c = x[2] - fixed[2];
        return std::vector<Real>{fixed[0] + Real(0.999) * a, fixed[1] + Real(0.6) * b - Real(0.7) * c,
                                 fixed[2] + Real(0.7) * b + Real(0.6) * c};
    };
    AndersonMixing mixing;
    std::vector<Real> x{0, 0, 0};
    for (int evaluation = 0; evaluation < 4; ++evaluation) x = mixing.next_point(x, map(x));
    constexpr Real tolerance = 1e-9; // the slow mode's residual is 1e-3 of its distance
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(x[i], fixed[i], tolerance);
}

} // namespace
