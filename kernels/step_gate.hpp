// SPDX-License-Identifier: MIT
// Steps launched ahead of what the host knows. A drift that finds a grain beyond its share of the skin finishes its
// step and closes the gate: the kernels of all later steps do nothing until the host has noticed, searched and opened
// it again. So no pair is missed, the bits are those of a host that waits for every step, and the host need not wait
// for any.
#pragma once

#include "core/types.hpp"

#include <limits>

namespace arenite {

/// What a kernel asks before it works. A default gate is open.
struct StepGate {
    static constexpr int none = std::numeric_limits<int>::max();

    int const* stale_step = nullptr; // on the device: the step whose drift found the list stale, or none
    int step = 0;                    // the kernel's own

    KOKKOS_FORCEINLINE_FUNCTION bool closed() const { return stale_step && *stale_step < step; }
};

} // namespace arenite
