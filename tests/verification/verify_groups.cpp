// SPDX-License-Identifier: MIT
// Runs what `arenite verify` runs, a test a group; every row that fails is printed.
#include "apps/verify/verify.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

namespace arenite {
namespace {

void expect_all_pass(std::string const& group)
{
    std::vector<VerifyCase> const cases = run_verification(group);
    EXPECT_FALSE(cases.empty());
    for (VerifyCase const& row : cases)
        EXPECT_TRUE(row.pass) << row.name << ", " << row.quantity << ": " << row.value << ", reference " << row.reference
                              << ", error " << row.error << " over " << row.limit;
    if (std::getenv("ARENITE_SHOW_TABLE")) std::cout << verification_table(cases);
}

TEST(Verify, Contact) { expect_all_pass("contact"); }
TEST(Verify, Friction) { expect_all_pass("friction"); }
TEST(Verify, Integrator) { expect_all_pass("integrator"); }
TEST(Verify, Search) { expect_all_pass("search"); }
TEST(Verify, Fluid) { expect_all_pass("fluid"); }
TEST(Verify, Coupling) { expect_all_pass("coupling"); }
TEST(Verify, CoarseGraining) { expect_all_pass("coarse_graining"); }

} // namespace
} // namespace arenite
