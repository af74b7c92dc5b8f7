// SPDX-License-Identifier: MIT
#include "core/cell_list.hpp"

#include "core/work_array.hpp"

namespace arenite {
namespace {

void count_items(View1<int> const& cell_of_item, int items, View1<int> const& count)
{
    Kokkos::parallel_for(
        "count_items", RangePolicy(0, items), KOKKOS_LAMBDA(int item) {
            int const cell = cell_of_item(item);
            if (cell >= 0) Kokkos::atomic_inc(&count(cell)); // integers: the sum has no order
        });
}

int scan_counts(View1<int> const& begin, int cells)
{
    int total = 0;
    Kokkos::parallel_scan(
        "scan_counts", RangePolicy(0, cells + 1),
        KOKKOS_LAMBDA(int cell, int& offset, bool last) {
            int const count = begin(cell);
            if (last) begin(cell) = offset;
            offset += count;
        },
        total);
    return total;
}

void fill_cells(View1<int> const& cell_of_item, int items, CellList const& list, View1<int> const& cursor,
                View1<int> const& filled)
{
    Kokkos::parallel_for(
        "fill_cells", RangePolicy(0, items), KOKKOS_LAMBDA(int item) {
            int const cell = cell_of_item(item);
            if (cell >= 0) filled(list.begin(cell) + Kokkos::atomic_fetch_add(&cursor(cell), 1)) = item;
        });
}

KOKKOS_INLINE_FUNCTION bool before(View1<GrainId> const& id, int a, int b)
{
    return id(a) < id(b) || (id(a) == id(b) && a < b);
}

/// The fill's order inside a cell is the scheduler's; an insertion sort makes it ours.
void sort_cells(View1<GrainId> const& id, CellList const& list, int cells)
{
    Kokkos::parallel_for(
        "sort_cells", RangePolicy(0, cells), KOKKOS_LAMBDA(int cell) {
            int const first = list.begin(cell), last = list.begin(cell + 1);
            for (int k = first + 1; k < last; ++k) {
                int const item = list.item(k);
                int slot = k;
                for (; slot > first && before(id, item, list.item(slot - 1)); --slot) list.item(slot) = list.item(slot - 1);
                list.item(slot) = item;
            }
        });
}

/// The same by counting who comes first, an entry a thread: on a device the cell with most items keeps nobody waiting.
void rank_entries(View1<int> const& cell_of_item, View1<GrainId> const& id, CellList const& list, View1<int> const& filled)
{
    Kokkos::parallel_for(
        "rank_entries", RangePolicy(0, list.entries), KOKKOS_LAMBDA(int entry) {
            int const item = filled(entry), cell = cell_of_item(item), first = list.begin(cell);
            int rank = 0;
            for (int k = first; k < list.begin(cell + 1); ++k) rank += before(id, filled(k), item) ? 1 : 0;
            list.item(first + rank) = item;
        });
}

} // namespace

CellList make_cell_list(View1<int> const& cell_of_item, View1<GrainId> const& id, int items, int cells,
                        CellList const& spare)
{
    // One array for what is counted and one for what is listed: a search allocates these anew (core/work_array.hpp).
    CellList list = spare;
    int const counters = 2 * cells + 1;
    fit(list.begin, "cell_begin", counters);
    Kokkos::deep_copy(ExecutionSpace(), rows_of(list.begin, 0, counters), 0);
    View1<int> const cursor = rows_of(list.begin, cells + 1, counters);
    count_items(cell_of_item, items, list.begin);
    list.entries = scan_counts(list.begin, cells);
    fit(list.item, "cell_item", on_host ? list.entries : 2 * list.entries);
    if (on_host) {
        fill_cells(cell_of_item, items, list, cursor, list.item);
        sort_cells(id, list, cells);
    } else {
        View1<int> const filled = rows_of(list.item, list.entries, 2 * list.entries);
        fill_cells(cell_of_item, items, list, cursor, filled);
        rank_entries(cell_of_item, id, list, filled);
    }
    return list;
}

} // namespace arenite
