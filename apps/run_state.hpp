// SPDX-License-Identifier: MIT
// Everything that changes in a run. A checkpoint holds all of it (apps/run_checkpoint.hpp).
#pragma once

#include "apps/energy_account.hpp"
#include "apps/grain_groups.hpp"
#include "core/contact_list.hpp"
#include "core/particles.hpp"
#include "core/reproducible_sum.hpp"
#include "core/walls.hpp"
#include "fluid/advance_flow.hpp"
#include "fluid/exchange.hpp"
#include "kernels/integrate.hpp"
#include "kernels/wall_contacts.hpp"

#include <memory>
#include <optional>

namespace arenite {

/// Where the run is. Counts, never sums of steps: times are made from them.
struct Clock {
    int stage = 0;               // in the plan
    std::int64_t step = 0;       // grain steps since the start of the run
    std::int64_t stage_step = 0; // since the start of the stage
    Real stage_start = 0;        // s
    Real dt = 0;                 // s, of the stage

    Real time() const { return stage_start + static_cast<Real>(stage_step) * dt; }
    Real stage_time() const { return static_cast<Real>(stage_step) * dt; }
};

/// The fluid's part; a run whose stages have no fluid never makes one.
struct FluidState {
    Region box; // m, settled when the fluid was made
    Flow flow;
    FlowBoundary boundary;
    FlowSolver solver;
    Exchange exchange;
    FlowReport report;
};

struct Tally {
    Real produced_mass = 0; // kg
    std::int64_t produced_count = 0;
    Real lost_mass = 0; // kg of grains that left the domain other than through the outlet
    std::int64_t lost_count = 0;
};

/// What the running stage has to tell at its end, in checkpoints so that a resumed run tells it too.
struct StageRecord {
    Real highest_overlap_ratio = 0;
    Real highest_step_ratio = 0; // dt over the stability limit of the stiffest contact that a look saw
};

struct RunState {
    Clock clock;
    Particles particles;
    GrainGroups groups;
    PeriodicBox box;
    Vec3 lasting_strain_rate; // 1/s, of the axes of the box that hold a stress: their servos' memory
    Walls walls;
    ContactList contacts;
    std::uint64_t inputs = 0; // hash_of_inputs when the run or its resume began: the files are needed no longer
    WallContacts wall_contacts;
    Integrator integrator;
    std::unique_ptr<FluidState> fluid;
    std::optional<EnergyAccount> energy; // where the scene asks for a balance
    Tally tally, stage_tally;            // now, and when the stage began
    StageRecord record;
    Real skin = 0;                // m, adapts to how often the list goes stale
    std::int64_t last_search = 0; // step
    Real tuned_friction = -1;     // of the running stage while it tunes; below 0: the material's own
    SumWorkspace sums;            // scratch
};

} // namespace arenite
