// SPDX-License-Identifier: MIT
// The checks of grains and fluid together, in the order in which verify.cpp lists them.
#pragma once

#include "apps/verify/verify_case.hpp"

namespace arenite {

std::vector<VerifyCase> check_single_grain();     // C1
std::vector<VerifyCase> check_light_fluid();      // C1b
std::vector<VerifyCase> check_rising_gas();       // MFIX DEM06
std::vector<VerifyCase> check_cell_sizes();       // C2
std::vector<VerifyCase> check_momentum_balance(); // C3
std::vector<VerifyCase> check_fixed_bed();        // C4
std::vector<VerifyCase> check_ergun_bed();        // C4b
std::vector<VerifyCase> check_paper_bed();        // C4c, G4
std::vector<VerifyCase> check_fluid_steps();      // C13
std::vector<VerifyCase> check_fluidisation();     // C5
std::vector<VerifyCase> check_bed_expansion();    // C5b
std::vector<VerifyCase> check_batch_settling();   // C7

} // namespace arenite
