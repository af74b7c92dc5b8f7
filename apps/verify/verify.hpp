// SPDX-License-Identifier: MIT
// Closed-form checks: each compares what the code computes with a value known from algebra or print.
// `arenite verify [GROUP]` prints them, the verification tests run the same functions.
//
// A group is a name and a list of functions (checks.hpp, verify.cpp); a new check is one function that
// returns its rows and one entry in that list.
#pragma once

#include "core/real.hpp"

#include <string>
#include <vector>

namespace arenite {

struct VerifyCase {
    std::string group;
    std::string name;     // what is set up
    std::string quantity; // what is compared, with its unit
    Real value = 0;
    Real reference = 0;
    Real error = 0; // relative; absolute where the reference is 0
    Real limit = 0;
    std::string source; // author and year of the reference, or "closed form"
    bool pass = false;
};

using VerifyCheck = std::vector<VerifyCase> (*)();

struct VerifyGroup {
    std::string name;
    std::vector<VerifyCheck> checks;
};

/// Every group in the order of the table.
std::vector<VerifyGroup> const& verify_groups();

/// Runs one group, or all of them for "". Throws InputError for a name that is none, naming those that are.
std::vector<VerifyCase> run_verification(std::string const& group);

/// The table that `arenite verify` prints; its last line counts the rows that fail.
std::string verification_table(std::vector<VerifyCase> const& cases);

/// A JSON array with one object a row; numbers that are not finite become null.
std::string verification_json(std::vector<VerifyCase> const& cases);

bool all_pass(std::vector<VerifyCase> const& cases);

} // namespace arenite
