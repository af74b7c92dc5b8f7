// SPDX-License-Identifier: MIT
// Wall time by phase and by kernel, for who has no profiler at hand: `--kernel-times` of run and bench. It listens to
// the callbacks of Kokkos Tools, through which nsys, kokkos-tools and the like see the same names (KOKKOS_TOOLS_LIBS).
//
// While it listens, Kokkos waits for the device before and after every kernel, so that a time is that kernel's own: on
// a GPU the sum is longer than a run without it, by the launches that would have overlapped.
#pragma once

#include <string>

namespace arenite {

/// From here on times are taken. Throws InputError if another tool listens already.
void start_kernel_times();

/// Stops. Two tables: phases, which hold what they call, and kernels and copies, each with calls, seconds and its share
/// of the time since the start.
std::string finish_kernel_times();

} // namespace arenite
