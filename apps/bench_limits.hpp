// SPDX-License-Identifier: MIT
// What the machine can do and what a grain step asks of it: the two sides of a roofline (Williams, Waterman & Patterson
// 2009).
#pragma once

#include "core/scene.hpp"

namespace arenite {

/// Bytes/s of a copy between two arrays that take `bytes` together, read and written, as McCalpin's STREAM counts them
/// (what a cache reads before it writes is not counted). Best of several, with the threads that Kokkos has.
double copy_bandwidth(double bytes);

/// Flop/s of multiply-adds in independent chains of registers, two to a multiply-add; best of several.
double multiply_add_rate();

/// Of one grain in one step.
struct StepCost {
    double bytes = 0, flops = 0;
};

/// Counted by hand from the kernels' source (bench_limits.cpp says what is counted): compulsory traffic of the kernels
/// evaluate_contacts and kick_and_drift, and useful arithmetic, history on, closed box, one material.
struct StepCounts {
    double contacts = 0, candidates = 0;
    double gathered = 0; // rows of forces: of the close candidates, and of all of a grain that is awake
    double shared = 0;   // of these, rows that the passes of a step share (kernels/contact_passes.hpp); 0: one pass
};
StepCost step_cost(NormalLaw law, StepCounts const& per_grain);

} // namespace arenite
