// SPDX-License-Identifier: MIT
// The first half of a contact search: grains into the order of a space-filling curve, and the pairs that are within reach.
#pragma once

#include "kernels/contact_search.hpp"

namespace arenite {

/// Checks and wraps positions and puts the grains that stay into locality order; returns the row that each came from.
/// spare: at least as many records as there are grains, given up for others (permute, core/particles.hpp).
View1<int> sort_grains(Particles& particles, PeriodicBox const& box, SearchSettings const& settings, RecordView& spare);

/// A list's pairs, and where the grains are; needs, periodic and the memory of reference_position are set. What its contacts
/// remember is allocated and still to be written.
void find_pairs(Particles const& particles, PeriodicBox const& box, SearchSettings const& settings, ContactList& contacts);

} // namespace arenite
