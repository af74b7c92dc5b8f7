// SPDX-License-Identifier: MIT
// Items sorted into the cells of a grid, in each cell by id: the same list whatever the thread count or
// the order of the items. Used to sort grains for locality and to search contacts.
#pragma once

#include "core/types.hpp"

namespace arenite {

struct CellList {
    View1<int> begin; // [cell + 1] first entry of a cell; behind that work space
    View1<int> item;  // [entry] item, in a cell by ascending (id, item); behind that work space
    int entries = 0;
};

/// cell_of_item: [items] cell number, or -1 to leave the item out; id: [items]. Order inside a cell is by
/// id, then by item (ghost images share an id). The arrays of `spare`, a list that is not needed any more, are used again
/// where they are large enough.
CellList make_cell_list(View1<int> const& cell_of_item, View1<GrainId> const& id, int items, int cells,
                        CellList const& spare = {});

} // namespace arenite
