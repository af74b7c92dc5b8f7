// SPDX-License-Identifier: MIT
// The checks of coarse graining, in the order in which verify.cpp lists them.
#pragma once

#include "apps/verify/verify_case.hpp"

namespace arenite {

std::vector<VerifyCase> check_coarse_grained_pair(); // G1
std::vector<VerifyCase> check_coarse_speeds();       // G1
std::vector<VerifyCase> check_lattice_stress();      // G2, D14
std::vector<VerifyCase> check_coarse_bed();          // G4
std::vector<VerifyCase> check_coarse_step();         // G6
std::vector<VerifyCase> check_coarse_settling();     // G7

} // namespace arenite
