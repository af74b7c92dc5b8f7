// SPDX-License-Identifier: MIT
// Finds the pairs of grains that are closer than a skin, on the device, by a cell grid per size level
// (hierarchical grids; Ogarko & Luding 2012), and carries the contacts' memory over by id. A grain looks
// in its own level and in the coarser ones, so a large grain does not make the cells of small ones large:
// candidates stay few for any ratio of sizes.
#pragma once

#include "core/contact_list.hpp"
#include "core/material.hpp"
#include "core/particles.hpp"

namespace arenite {

/// On a host a list of so many grains has tiles: 5 MB of force rows for each thread that works on one. With smaller tiles
/// more pairs are across tiles: with 1 021 000 grains steps of tiles of 16384 take 1.03 times as long (Xeon, one thread).
/// Neither number depends on the threads, so that sums over contacts do not.
inline constexpr int least_tiled_grains = 262144, default_tile_grains = 32768;

struct SearchSettings {
    Real skin = 0; // m: pairs with a smaller gap are listed
    ContactNeeds needs;
    View1<int> keep;          // [grain] 0: the grain leaves the run (produced, lost); empty: all stay
    bool whole_steps = false; // forces of all contacts are read after every step: the list gets no tiles
    int tile_grains = 0;      // 0: as many as suit the caches
    // All contacts are evaluated before anyone reads a force row: the rows begin with zeros, in memory of the old list's.
    bool forces_follow = false;
};

/// Sorts the grains along a space-filling curve, wraps them into the periodic box, and rebuilds the list.
/// Springs and bonds of pairs that stay are carried over exactly; a pair that leaves the list is forgotten
/// (it is farther apart than any contact reaches). Grains that are not kept are dropped.
/// Where forces follow, the search takes hardly more memory than the list that it leaves.
/// Throws InputError if a periodic edge is shorter than two cutoffs: a pair would meet twice.
void search_contacts(Particles& particles, PeriodicBox const& box, SearchSettings const& settings, ContactList& contacts);

/// A list that came out of a checkpoint holds what it was built from and what its contacts remember (count, needs, periodic,
/// tile_grains, row_begin, second, image, touching, adhering, spring, force, reference_position); this adds what follows
/// from that. The grains are in the rows that they had. Then the list goes stale when it would have.
void complete_list(Particles const& particles, ContactList& contacts);

/// What touches becomes a bond, where its pair of materials bonds at the start. Returns how many bonds there are then.
int form_bonds(Particles const& particles, PeriodicBox const& box, ContactList const& contacts, PairTable const& pairs);

/// Bonds and touching contacts per grain, [grain], into Views of the owned count.
void count_bonds(Particles const& particles, ContactList const& contacts, View1<int> const& bonds,
                 View1<int> const& coordination);

} // namespace arenite
