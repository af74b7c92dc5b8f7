// SPDX-License-Identifier: MIT
#include "apps/bench_limits.hpp"

#include "apps/seconds_of.hpp"
#include "core/lanes.hpp"
#include "core/types.hpp"

#include <algorithm>
#include <chrono>

namespace arenite {
namespace {

/// Seconds of one run of the kernel, best of five trials; each of them repeats it for a twentieth of a second.
template <class Kernel> double best_time(char const* name, int items, Kernel const& kernel)
{
    double best = 1e30;
    for (int trial = 0; trial < 6; ++trial) { // the first touches the memory
        Kokkos::fence();
        auto const begin = std::chrono::steady_clock::now();
        double seconds = 0;
        int calls = 0;
        for (; seconds < 0.05; ++calls) {
            Kokkos::parallel_for(name, RangePolicy(0, items), kernel);
            Kokkos::fence();
            seconds = seconds_since(begin);
        }
        best = std::min(best, seconds / calls);
    }
    return best;
}

struct Copy {
    View1<Real> from, to;
    KOKKOS_FUNCTION void operator()(int i) const { to(i) = from(i); }
};

struct MultiplyAdd {
    // Enough chains to hide the latency of each, few enough for 16 registers.
    static constexpr int chains = 12, rounds = 2000;
    View1<Real> result;

    KOKKOS_FUNCTION void operator()(int i) const
    {
        Lanes value[chains];
        for (int n = 0; n < chains; ++n) value[n] = Lanes(Real(1e-3) * (n + i));
        for (int round = 0; round < rounds; ++round)
            for (int n = 0; n < chains; ++n) value[n] = value[n] * Real(0.999) + Real(1e-3);
        Lanes sum = value[0];
        for (int n = 1; n < chains; ++n) sum += value[n];
        result(i) = lane(sum, 0);
    }
};

} // namespace

double copy_bandwidth(double bytes)
{
    int const count = std::max(1, static_cast<int>(bytes / (2 * sizeof(Real))));
    Copy const copy{View1<Real>("copy_from", count), View1<Real>("copy_to", count)};
    return 2 * sizeof(Real) * static_cast<double>(count) / best_time("copy", count, copy);
}

double multiply_add_rate()
{
    int const items = on_host ? 100 * ExecutionSpace().concurrency() : 1 << 20;
    double const seconds = best_time("multiply_add", items, MultiplyAdd{View1<Real>("multiply_add", items)});
    return 2.0 * lane_count * MultiplyAdd::chains * MultiplyAdd::rounds * items / seconds;
}

// Bytes. What a kernel must read or write once if nothing but what it works on at the moment stays in the cache; a
// grain's record is counted once a kernel, however many of its contacts read it.
//   evaluate_contacts, a candidate:   first, second 8; touching 1; adhering 1 (JKR)
//                      a contact:     scale 16, or 24 (JKR); spring 24 + 24; force 64; touching 1; adhering 1 (JKR)
//                      a grain:       position, velocity, spin 96
//   kick_and_drift,    a gathered row: incident 4 + 4; force 64
//                      a grain:       position, velocity, spin 2 x 96; reference position 32; motion 1; list ends 8; awake 1
// In passes the rows that they share never leave the caches, and a grain's records are read once.
// Flops. An addition, product, quotient or root is one; a comparison, a selection or a change of sign none.
//   a candidate:  offset 3, its square 5, reach 1; a gathered row: on both sides 2 x 12
//   a contact:    distance, normal, overlap, arms 16; approach 3; turn of the line of centres 50; spins 12; slip 40;
//                 twist 7; spring's transport 40; dashpot and sums 13; tangential spring and limits 45; moment 9; Hertz 5,
//                 or JKR's curve 59 and its limit 2
//   a grain:      weight 6, check 15, two half kicks 28, move 24
StepCost step_cost(NormalLaw law, StepCounts const& per_grain)
{
    bool const jkr = law != NormalLaw::hertz;
    double const contacts = per_grain.contacts, candidates = per_grain.candidates, gathered = per_grain.gathered;
    StepCost cost;
    cost.bytes = candidates * (9 + jkr) + gathered * 72 + contacts * (129 + 9 * jkr) + 96 + 234;
    if (per_grain.shared > 0) cost.bytes -= 64 * (per_grain.shared + std::min(per_grain.shared, contacts)) + 96;
    cost.flops = candidates * 9 + gathered * 24 + contacts * (235 + (jkr ? 61 : 5)) + 73;
    return cost;
}

} // namespace arenite
