// SPDX-License-Identifier: MIT
#include "fluid/deposit.hpp"

#include "core/error.hpp"
#include "core/work_array.hpp"
#include "fluid/deposit_by_blocks.hpp"
#include "fluid/deposit_by_teams.hpp"

#include <algorithm>
#include <cmath>

namespace arenite {
namespace {

constexpr int grains_per_bin = 8; // short enough for an insertion sort

/// Integral of 15/16 (1 - s^2)^2 from -1 to s, 0 and 1 beyond the support.
template <class N> KOKKOS_FORCEINLINE_FUNCTION N kernel_integral(N const& s)
{
    N const square = s * s;
    N const inner = Real(0.5) + Real(15) / 16 * s * (1 - square * (Real(2) / 3 - square * (Real(1) / 5)));
    return select(s <= N(-1), N(0), select(s >= N(1), N(1), inner));
}

/// A coordinate in cells from the box's lower face, brought into a periodic box; -1 outside the box. One number and lanes
/// round alike (the product is of whole numbers): a grain's bin and its weights must name the same start cell.
template <class N> KOKKOS_FORCEINLINE_FUNCTION N cell_coordinate(Grid const& grid, int axis, N const& coordinate)
{
    Real const cells = grid.cells[axis];
    N scaled = (coordinate - grid.lower[axis]) / grid.spacing[axis];
    if (grid.periodic[axis]) scaled -= cells * rounded_down(scaled / cells);
    return select(scaled >= N(0) && scaled <= N(cells), scaled, N(-1));
}

/// First cell that the kernel touches, a whole number, before it is brought into the box.
template <class N> KOKKOS_FORCEINLINE_FUNCTION N first_touched(DepositStencil const& stencil, int axis, N const& scaled)
{
    return rounded_down(scaled - stencil.support_radius / stencil.grid.spacing[axis]);
}

/// That cell in the box: the start of the grain's block.
template <class N> KOKKOS_FORCEINLINE_FUNCTION N start_cell(DepositStencil const& stencil, int axis, N const& scaled)
{
    if (stencil.starts[axis] == 1) return 0;
    N const first = first_touched(stencil, axis, scaled);
    if (stencil.grid.periodic[axis]) return select(first < N(0), first + Real(stencil.grid.cells[axis]), first);
    return larger(smaller(first, N(stencil.starts[axis] - 1)), N(0));
}

/// An axis of the table of weights: first column, and their number with the padding.
struct AxisColumns {
    int first, count;
};

KOKKOS_FUNCTION AxisColumns axis_columns(DepositStencil const& stencil, int axis)
{
    int const end[4] = {0, stencil.y_slot(), stencil.z_slot(), stencil.columns()};
    return {end[axis], end[axis + 1] - end[axis]};
}

/// The axis' columns of a grain a lane. weight_of(slot): called slot by slot, from the start cell on.
template <class WeightOf>
KOKKOS_FORCEINLINE_FUNCTION void write_slots(GrainWeights const& weights, int axis, int const (&entry)[lane_count],
                                             WeightOf const& weight_of)
{
    AxisColumns const columns = axis_columns(weights.stencil, axis);
    if constexpr (lane_count == 1)
        for (int slot = 0; slot < columns.count; ++slot)
            weights.weight(entry[0], columns.first + slot) = lane(weight_of(slot), 0);
    else
        for (int slot = 0; slot < columns.count; slot += 4) {
            Lanes const w[4] = {weight_of(slot), weight_of(slot + 1), weight_of(slot + 2), weight_of(slot + 3)};
            store_records_at({{w[0], w[1], w[2]}, w[3]},
                             [&](int n) { return &weights.weight(entry[n], columns.first + slot); });
        }
}

/// Start cells of the axis.
KOKKOS_FORCEINLINE_FUNCTION Lanes write_axis_weights(GrainWeights const& weights, int axis, Lanes const& coordinate,
                                                     int const (&entry)[lane_count])
{
    DepositStencil const& stencil = weights.stencil;
    Lanes const scaled = cell_coordinate(stencil.grid, axis, coordinate);
    Lanes const first = first_touched(stencil, axis, scaled);
    Lanes const cells_per_radius = stencil.grid.spacing[axis] / stencil.support_radius;
    int const touched = stencil.touched[axis], cells = stencil.grid.cells[axis];
    if (stencil.slots[axis] == touched && all(first >= Lanes(0) && first + Real(touched) <= Lanes(cells))) { // in the box
        Lanes below = 0;
        write_slots(weights, axis, entry, [&](int slot) {
            if (slot >= touched) return Lanes(0);
            Lanes const above =
                slot + 1 < touched ? kernel_integral((first + Real(slot + 1) - scaled) * cells_per_radius) : Lanes(1);
            Lanes const weight = larger(above - below, Lanes(0)); // rounding may make it -1e-17
            below = above;
            return weight;
        });
        return first;
    }
    // What lies outside the box belongs to the periodic image there, or to the mirror image in the wall: `box` of a row of
    // images, of which the grain's own is number 0.
    bool const periodic = stencil.grid.periodic[axis];
    int const boxes = touched / cells + 2;
    Lanes const last = first + Real(touched - 1);
    Lanes const start = start_cell(stencil, axis, scaled);
    write_slots(weights, axis, entry, [&](int slot) {
        Lanes weight = 0;
        if (slot >= stencil.slots[axis]) return weight;
        Lanes const cell = start + Real(slot);
        for (int box = -boxes; box <= boxes; ++box) {
            Lanes const index = (periodic || box % 2 == 0 ? cell : Real(cells - 1) - cell) + Real(box * cells);
            LaneMask const shares = index >= first && index <= last;
            if (!any(shares)) continue;
            Lanes const below = select(index > first, kernel_integral((index - scaled) * cells_per_radius), Lanes(0));
            Lanes const above =
                select(index < last, kernel_integral((index + Real(1) - scaled) * cells_per_radius), Lanes(1));
            weight += select(shares, larger(above - below, Lanes(0)), Lanes(0));
        }
        return weight;
    });
    return start;
}

/// Number of the bin that holds a grain: its block, and in it bins_per_axis^3 bins by the place in a cell.
void number_bins(DepositStencil const& stencil, RecordView const& position, int count, int bins_per_axis,
                 View1<int> const& bin)
{
    Real const bins_per_block = bins_per_axis * bins_per_axis * bins_per_axis;
    Kokkos::parallel_for(
        "number_bins", RangePolicy(0, lane_groups(count)), KOKKOS_LAMBDA(int group) {
            int row[lane_count];
            items_of_group(group, count, row);
            LaneRecords const at = load_records(position.data(), row);
            Lanes block = 0, inner = 0;
            LaneMask inside(true);
            for (int axis = 2; axis >= 0; --axis) {
                Lanes const scaled = cell_coordinate(stencil.grid, axis, at.xyz[axis]);
                inside = inside && scaled >= Lanes(0);
                Lanes const place = rounded_down((scaled - rounded_down(scaled)) * Real(bins_per_axis));
                block = block * Real(stencil.starts[axis]) + start_cell(stencil, axis, scaled);
                inner = inner * Real(bins_per_axis) + smaller(place, Lanes(bins_per_axis - 1));
            }
            Lanes const number =
                select(inside, block * bins_per_block + inner, Lanes(-1)); // exact: a bin's number is an int
            for (int n = 0; n < lane_count; ++n) bin(row[n]) = static_cast<int>(lane(number, n));
        });
}

void write_weights(GrainWeights const& weights, RecordView const& position)
{
    Kokkos::parallel_for(
        "write_weights", RangePolicy(0, weights.entry_groups()), KOKKOS_LAMBDA(int group) {
            int entry[lane_count], row[lane_count];
            weights.entries_of(group, entry, row);
            for (int n = 0; n < lane_count; ++n) prefetch(&position(weights.later_row(entry[n]), 0));
            LaneRecords const at = load_records(position.data(), row);
            DepositStencil const& stencil = weights.stencil;
            Lanes number = 0;
            LaneMask whole(true);
            for (int axis = 2; axis >= 0; --axis) {
                Real const cells = stencil.grid.cells[axis];
                Lanes const start = write_axis_weights(weights, axis, at.xyz[axis], entry);
                number = number * cells + start;
                whole = whole && start + Real(stencil.slots[axis]) <= Lanes(cells);
            }
            Lanes const cell = select(whole, number, Lanes(-1));
            for (int n = 0; n < lane_count; ++n) {
                auto const first = static_cast<int>(lane(cell, n));
                weights.first_cell(entry[n]) = first >= 0 ? first : -1 - weights.bin(row[n]) / weights.bins_per_block;
            }
        });
}

} // namespace

DepositStencil make_deposit_stencil(Grid const& grid, Real support_radius)
{
    DepositStencil stencil;
    stencil.grid = grid;
    Real const widest = std::max({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    stencil.support_radius = support_radius > 0 ? support_radius : Real(1.5) * widest;
    for (int axis = 0; axis < 3; ++axis) {
        int const cells = grid.cells[axis];
        constexpr Real slack = 1e-9; // a whole number of cells is meant as such
        Real const width = 2 * stencil.support_radius / grid.spacing[axis];
        if (!(width < 1000)) throw InputError("fluid.smoothing_length is more than 500 cells");
        stencil.touched[axis] = static_cast<int>(std::ceil(width - slack)) + 1;
        stencil.slots[axis] = std::min(stencil.touched[axis], cells);
        bool const whole = stencil.slots[axis] == cells;
        stencil.starts[axis] = whole ? 1 : (grid.periodic[axis] ? cells : cells - stencil.slots[axis] + 1);
    }
    stencil.groups = (stencil.slots[0] + DepositStencil::group - 1) / DepositStencil::group;
    stencil.row_groups = (stencil.slots[1] + DepositStencil::rows_at_once - 1) / DepositStencil::rows_at_once;
    return stencil;
}

GrainWeights make_grain_weights(DepositStencil const& stencil, RecordView const& position, View1<GrainId> const& id,
                                int count, GrainWeights const& spare)
{
    GrainWeights weights = spare;
    weights.stencil = stencil;
    double const bins_per_block = static_cast<double>(count) / grains_per_bin / stencil.block_count();
    int const bins_per_axis = std::max(1, static_cast<int>(std::cbrt(bins_per_block)));
    weights.bins_per_block = bins_per_axis * bins_per_axis * bins_per_axis;
    fit(weights.bin, "bin_of_grain", count);
    number_bins(stencil, position, count, bins_per_axis, weights.bin);
    weights.bins = make_cell_list(weights.bin, id, count, stencil.block_count() * weights.bins_per_block, spare.bins);
    weights.entries = weights.bins.entries;
    auto const rows = static_cast<std::size_t>(weights.entries), columns = static_cast<std::size_t>(stencil.columns());
    fit(weights.first_cell, "first_cell_of_entry", rows);
    if (weights.weight.extent(0) < rows || weights.weight.extent(1) != columns)
        weights.weight = WeightView(uninitialized("grain_weights"), rows, columns);
    if (on_host) reserve_block_sums(weights);
    else weights.chunks = make_deposit_chunks(weights, spare.chunks);
    write_weights(weights, position);
    return weights;
}

void deposit(GrainWeights const& weights, TableView const& quantity, TableView const& cell, int components)
{
    if (on_host) deposit_by_blocks(weights, quantity, cell, components);
    else deposit_by_teams(weights, quantity, cell, components);
}

} // namespace arenite
