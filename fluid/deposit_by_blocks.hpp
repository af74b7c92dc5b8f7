// SPDX-License-Identifier: MIT
// The deposit of a host: a work item adds up all grains of a block of cells for some of the block's rows, and another one,
// for a cell, what the blocks have for it. Both orders are fixed. For a device: deposit_by_teams.hpp.
#pragma once

#include "fluid/deposit.hpp"

namespace arenite {

void reserve_block_sums(GrainWeights& weights);

/// As deposit, for weights whose sums have room.
void deposit_by_blocks(GrainWeights const& weights, TableView const& quantity, TableView const& cell, int components);

} // namespace arenite
