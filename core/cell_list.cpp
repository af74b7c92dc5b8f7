// SPDX-License-Identifier: MIT
#include "core/cell_list.hpp"

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

void fill_cells(View1<int> const& cell_of_item, int items, CellList const& list)
{
    Kokkos::parallel_for(
        "fill_cells", RangePolicy(0, items), KOKKOS_LAMBDA(int item) {
            int const cell = cell_of_item(item);
            if (cell >= 0) list.item(list.begin(cell) + Kokkos::atomic_fetch_add(&list.cursor(cell), 1)) = item;
        });
}

/// The fill's order inside a cell is the scheduler's; insertion sort by (id, item) makes it ours.
void sort_cells(View1<GrainId> const& id, CellList const& list, int cells)
{
    Kokkos::parallel_for(
        "sort_cells", RangePolicy(0, cells), KOKKOS_LAMBDA(int cell) {
            int const first = list.begin(cell), last = list.begin(cell + 1);
            for (int k = first + 1; k < last; ++k) {
                int const item = list.item(k);
                GrainId const key = id(item);
                int slot = k;
                while (slot > first) {
                    int const other = list.item(slot - 1);
                    if (id(other) < key || (id(other) == key && other < item)) break;
                    list.item(slot) = other;
                    --slot;
                }
                list.item(slot) = item;
            }
        });
}

/// At least `length` entries, that many of them zero.
void fill_zero(View1<int>& array, std::string const& label, int length)
{
    if (array.extent_int(0) < length) array = View1<int>(label, length);
    else Kokkos::deep_copy(ExecutionSpace(), Kokkos::subview(array, Kokkos::make_pair(0, length)), 0);
}

} // namespace

CellList make_cell_list(View1<int> const& cell_of_item, View1<GrainId> const& id, int items, int cells,
                        CellList const& spare)
{
    CellList list = spare;
    fill_zero(list.begin, "cell_begin", cells + 1);
    fill_zero(list.cursor, "cell_cursor", cells);
    count_items(cell_of_item, items, list.begin);
    list.entries = scan_counts(list.begin, cells);
    if (list.item.extent_int(0) < list.entries) list.item = View1<int>(uninitialized("cell_item"), list.entries);
    fill_cells(cell_of_item, items, list);
    sort_cells(id, list, cells);
    return list;
}

} // namespace arenite
