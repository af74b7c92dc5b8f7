// SPDX-License-Identifier: MIT
// The tables around the closed-form checks.
#include "apps/verify/verify_case.hpp"
#include "core/error.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace arenite {
namespace {

TEST(VerifyTable, ErrorsAreRelativeUnlessTheReferenceIsZero)
{
    EXPECT_DOUBLE_EQ(compare({"a", "b", "c"}, 99, 100, 0.02).error, 0.01);
    EXPECT_TRUE(compare({"a", "b", "c"}, 99, 100, 0.02).pass);
    EXPECT_FALSE(compare({"a", "b", "c"}, 97, 100, 0.02).pass);
    EXPECT_DOUBLE_EQ(compare({"a", "b", "c"}, 0.5, 0, 1).error, 0.5);
    EXPECT_FALSE(compare({"a", "b", "c"}, std::numeric_limits<Real>::quiet_NaN(), 1, 1).pass);
    EXPECT_FALSE(expect_true({"a", "b", "c"}, false).pass);
}

TEST(VerifyTable, PrintsWhatFailed)
{
    std::vector<VerifyCase> const cases{compare({"good", "q", "s"}, 1, 1, 0), compare({"bad", "q", "s"}, 2, 1, 0.5)};
    EXPECT_FALSE(all_pass(cases));
    std::string const table = verification_table(cases);
    EXPECT_NE(table.find("FAIL"), std::string::npos);
    EXPECT_NE(table.find("2 checks, 1 failed"), std::string::npos);
}

TEST(VerifyTable, JsonEscapesAndHasNoNan)
{
    std::string const json =
        verification_json({compare({"say \"hi\"", "q", "s"}, std::numeric_limits<Real>::quiet_NaN(), 1, 0)});
    EXPECT_NE(json.find("say \\\"hi\\\""), std::string::npos);
    EXPECT_NE(json.find("\"value\": null"), std::string::npos);
    EXPECT_NE(json.find("\"pass\": false"), std::string::npos);
}

TEST(VerifyTable, UnknownGroupNamesTheKnown)
{
    try {
        run_verification("contcat");
        FAIL();
    } catch (InputError const& error) {
        for (VerifyGroup const& group : verify_groups())
            EXPECT_NE(std::string(error.what()).find(group.name), std::string::npos);
    }
}

} // namespace
} // namespace arenite
