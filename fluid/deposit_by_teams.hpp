// SPDX-License-Identifier: MIT
// The deposit of a device. On a host a work item adds up all grains of a block for some rows of its cells
// (deposit_by_blocks.hpp); a device wants ten thousand threads at once, and in a closed box the blocks at walls and corners
// hold several times the grains of others. So the entries are cut into chunks, each from one block. A team sums a chunk for
// all cells of the block, and another team adds up, for a cell, what the chunks have for it. Both orders are fixed.
#pragma once

#include "fluid/deposit.hpp"

namespace arenite {

/// Of the entries, which are sorted already. The arrays of `spare` are used again where they are large enough.
DepositChunks make_deposit_chunks(GrainWeights const& weights, DepositChunks const& spare);

/// As deposit, for weights whose chunks are made.
void deposit_by_teams(GrainWeights const& weights, TableView const& quantity, TableView const& cell, int components);

} // namespace arenite
