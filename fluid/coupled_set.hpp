// SPDX-License-Identifier: MIT
// Which grains the fluid saw in its last step. A grain that crosses an open boundary, or that is removed,
// takes its whole volume with it at once; seen as dn/dt that is an inflow of one grain volume in one fluid
// step, a blow of metres per second. So the volume is taken from both time levels (exchange.hpp).
#pragma once

#include "fluid/deposit.hpp"

namespace arenite {

struct CoupledSet {
    int count = -1;           // -1: no step was made yet
    std::uint64_t digest = 0; // of the ids, whatever their order
    View1<GrainId> id;        // [entry]
    RecordView position;      // [entry](x, y, z, radius), m
};

/// The grains of an entry list. storage: arrays of an earlier set to use again.
CoupledSet coupled_set(GrainWeights const& weights, Particles const& particles, CoupledSet const& storage);

/// Those grains of a that are not in b.
CoupledSet difference(CoupledSet const& a, CoupledSet const& b);

} // namespace arenite
