// SPDX-License-Identifier: MIT
// The checks of the fluid alone, in the order in which verify.cpp lists them.
#pragma once

#include "apps/verify/verify_case.hpp"

namespace arenite {

std::vector<VerifyCase> check_cavity();            // F1
std::vector<VerifyCase> check_vortices();          // F2
std::vector<VerifyCase> check_order_in_time();     // F10
std::vector<VerifyCase> check_channel();           // F3
std::vector<VerifyCase> check_brinkman();          // F3
std::vector<VerifyCase> check_relaxation();        // F4
std::vector<VerifyCase> check_darcy();             // F4
std::vector<VerifyCase> check_fluid_at_rest();     // H20
std::vector<VerifyCase> check_manufactured_flow(); // F5
std::vector<VerifyCase> check_porosity_jumps();    // F6
std::vector<VerifyCase> check_moving_porosity();   // F7
std::vector<VerifyCase> check_holes();             // F8
std::vector<VerifyCase> check_pressure_solver();   // F9

} // namespace arenite
