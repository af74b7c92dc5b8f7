// SPDX-License-Identifier: MIT
// The checks of the grains, in the order in which verify.cpp lists them.
#pragma once

#include "apps/verify/verify_case.hpp"

namespace arenite {

// contact: constants and collinear motion
std::vector<VerifyCase> check_pair_constants();
std::vector<VerifyCase> check_hertz_impacts();
std::vector<VerifyCase> check_restitution();
std::vector<VerifyCase> check_bouncing();
std::vector<VerifyCase> check_exact_touch();

// contact: adhesion
std::vector<VerifyCase> check_jkr_points();
std::vector<VerifyCase> check_jkr_curve();
std::vector<VerifyCase> check_work_of_peeling();
std::vector<VerifyCase> check_pull();
std::vector<VerifyCase> check_sticking();
std::vector<VerifyCase> check_bonded_release();
std::vector<VerifyCase> check_bonded_oscillation();

// friction
std::vector<VerifyCase> check_friction_cycle();
std::vector<VerifyCase> check_partial_slip();
std::vector<VerifyCase> check_shear_paths();
std::vector<VerifyCase> check_rigid_turns();
std::vector<VerifyCase> check_incline();
std::vector<VerifyCase> check_sliding_to_rolling();
std::vector<VerifyCase> check_gear_spin();
std::vector<VerifyCase> check_oblique_impacts();
std::vector<VerifyCase> check_spinning_impacts();

// integrator
std::vector<VerifyCase> check_free_fall();
std::vector<VerifyCase> check_pair_conservation();
std::vector<VerifyCase> check_many_bodies();
std::vector<VerifyCase> check_squeezed_pair();
std::vector<VerifyCase> check_critical_step();

// search
std::vector<VerifyCase> check_pairs_found();
std::vector<VerifyCase> check_periodic_crossing();
std::vector<VerifyCase> check_independence();

} // namespace arenite
