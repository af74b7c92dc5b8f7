// SPDX-License-Identifier: MIT
// The second half of a contact search: what follows from a list's pairs, and what its contacts remember of the list before.
// Its arrays are made one after the other, and those of the old list go as soon as nobody asks for them: both lists at a
// time would be most of a run's memory.
#pragma once

#include "core/contact_list.hpp"
#include "core/particles.hpp"

namespace arenite {

/// Contacts that were close when the list was built, from its row_begin.
int count_close(ContactList const& list);

/// The two grains of each contact and what it remembers but its force: [count] as it was where the list has them already,
/// else still to be written; what is padded behind them is.
void fit_memory(ContactList& contacts);

/// Rows of forces likewise, kept where the list has them.
void fit_forces(ContactList& contacts);

/// R*, m* and the cube root of each contact, from its two grains.
void make_scales(Particles const& particles, ContactList& contacts);

/// The exact rows of each grain's contacts in the order of its partners' ids, and who gathers the others (awake).
void make_incidence(Particles const& particles, ContactList& contacts);

/// What a list remembers of its contacts. The arrays of all else are free once the list itself is.
ContactList memory_of(ContactList const& list);

/// The memory of the list before, and where its contacts are: in the old row of their first grain, by their partner's id.
struct OldContacts {
    ContactList list;
    View1<GrainId> id; // [old row]
    View1<int> row;    // [grain] its row in the old list

    /// -1: a new pair.
    KOKKOS_FUNCTION int find(int grain, GrainId partner) const
    {
        int from = -1;
        for_each_owned(list, row(grain), [&](int k) {
            if (id(list.second(k)) == partner) from = k;
        });
        return from;
    }
};

/// What every contact remembers but its force; a new one begins with nothing.
void carry_memory(OldContacts const& old, Particles const& particles, ContactList const& contacts);

/// Rows of forces, all zero, in the memory of `spare` where that has as many; else spare's is free before theirs is taken.
void make_force_rows(ForceRows spare, ContactList& contacts);

/// The forces of contacts that touched; what does not touch may have an older force in the old row.
void carry_forces(OldContacts const& old, Particles const& particles, ContactList const& contacts);

} // namespace arenite
