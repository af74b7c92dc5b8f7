// SPDX-License-Identifier: MIT
// A box full of grains on a lattice (apps/bench_pack.hpp) and a fluid grid on it, every kernel of both ready to run:
// what the benchmarks of single kernels and of the coupling work on.
#pragma once

#include "apps/stage_forces.hpp"
#include "kernels/contact_search.hpp"

#include <array>

namespace arenite {

struct CoupledPack {
    static constexpr Real grain_dt = 1e-8, fluid_dt = 1e-6; // s, the paper's

    RunState state;
    PlannedStage planned;
    StageForces forces;
    StepSettings step;
    FluidState fluid;
    SearchSettings search;
};

/// Fills `pack`, which must stay where it is. Closed but for injection from one side and a free outflow at the top, as
/// the paper's sample; sand of 60 J/m2, under JKR all bonded.
void make_coupled_pack(int grains, std::array<int, 3> const& cells, NormalLaw law, CoupledPack& pack);

} // namespace arenite
