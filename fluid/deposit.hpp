// SPDX-License-Identifier: MIT
// Which share of a grain belongs to which fluid cell, and sums and means with these weights.
//
// A grain's volume is spread over the box of half width `support_radius` round its centre by the product of
// three 1-D kernels (15/16 (1 - s^2)^2, s = distance/support_radius), each integrated in closed form over the
// cells' intervals. So the weights w_jc are smooth in the grain's position, independent of the cell size,
// correct for a support below half a cell, and sum to 1 to rounding. What would lie behind a face that is not
// periodic is folded back (mirrored): a uniform pack is then uniform up to the wall.
//
// Sums over grains are gathered in fixed order: bits do not depend on threads or on the order of rows.
#pragma once

#include "core/cell_list.hpp"
#include "core/grid.hpp"
#include "core/lanes.hpp"
#include "core/particles.hpp"

#include <string>
#include <type_traits>

namespace arenite {

/// [item][component], component count chosen at run time.
using TableView = Kokkos::View<Real**, Kokkos::LayoutRight, MemorySpace>;

/// The same of weights. On a device, where neighbouring threads have neighbouring entries, a column's numbers follow each
/// other; on a host a row's.
using WeightView = Kokkos::View<Real**, std::conditional_t<on_host, Kokkos::LayoutRight, Kokkos::LayoutLeft>, MemorySpace>;

/// Extent of the weights: a grain touches `slots` cells along each axis, from its start cell on. Grains with
/// the same start cell share a block of cells. Near a wall, and in a box of fewer cells than slots, the
/// block is moved or cut so that it lies in the box.
struct DepositStencil {
    static constexpr int group = 4; // slots of x in a Quad; their storage is padded to it
    /// Slots of y that a host sums at once (deposit_by_blocks.hpp); y and z are padded to it.
    static constexpr int rows_at_once = lane_count > 1 ? 4 : 1;

    Grid grid;
    Real support_radius = 0;    // m
    int touched[3] = {1, 1, 1}; // most cells that the kernel touches on an axis without end
    int slots[3] = {1, 1, 1};   // cells of a block: touched, or the box's if these are fewer
    int starts[3] = {1, 1, 1};  // start cells 0 .. starts - 1
    int groups = 1;             // of x
    int row_groups = 1;         // of y, rows_at_once each

    KOKKOS_FUNCTION int y_slot() const { return group * groups; } // columns of GrainWeights::weight
    KOKKOS_FUNCTION int z_slot() const { return y_slot() + rows_at_once * row_groups; }
    KOKKOS_FUNCTION int columns() const { return z_slot() + (slots[2] + rows_at_once - 1) / rows_at_once * rows_at_once; }
    KOKKOS_FUNCTION int block_count() const { return starts[0] * starts[1] * starts[2]; }
    /// Number of the block with these start cells.
    KOKKOS_FUNCTION int block(int sx, int sy, int sz) const { return sx + starts[0] * (sy + starts[1] * sz); }
    /// Cell start + slot of an axis; the block of a periodic box may reach over its end.
    KOKKOS_FUNCTION int cell(int axis, int start, int slot) const
    {
        int const index = start + slot;
        return index < grid.cells[axis] ? index : index - grid.cells[axis];
    }
    /// The start cell whose slot is this cell, -1 if there is none.
    KOKKOS_FUNCTION int start(int axis, int cell, int slot) const
    {
        int const index = cell - slot;
        if (index >= 0) return index < starts[axis] ? index : -1;
        return starts[axis] == grid.cells[axis] && grid.periodic[axis] ? index + grid.cells[axis] : -1;
    }
};

/// support_radius in m; 0 stands for 1.5 times the largest cell edge.
DepositStencil make_deposit_stencil(Grid const& grid, Real support_radius);

/// How the entries are cut for a device's deposit (deposit_by_teams.hpp).
struct DepositChunks {
    View1<int> begin;    // [block + 1] first chunk of a block
    View1<int> block;    // [chunk]
    View1<Real> partial; // work space: sums of chunks
    int count = 0;
};

/// The grains in the fluid's box, sorted by (block, bin in the block, id), and their weights. An entry is a
/// grain in that order. Bins keep the sort cheap when a block holds thousands of grains.
struct GrainWeights {
    DepositStencil stencil;
    int entries = 0;
    int bins_per_block = 1;
    CellList bins;         // bins.item: [entry] row of the grain
    View1<int> first_cell; // [entry] number of the block's first cell; -1 - block where that reaches over a periodic end
    WeightView weight;     // [entry][slots of x, of y, of z, each padded with 0]
    View1<int> bin;        // work space: [row] number of the grain's bin
    View1<Real> partial;   // work space of a host's deposit
    DepositChunks chunks;  // a device's

    KOKKOS_FUNCTION int begin(int of_block) const { return bins.begin(of_block * bins_per_block); }
    /// In `weight`, between neighbouring entries and between columns.
    KOKKOS_FUNCTION std::ptrdiff_t entry_step() const { return on_host ? static_cast<std::ptrdiff_t>(weight.stride(0)) : 1; }
    KOKKOS_FUNCTION std::ptrdiff_t column_step() const
    {
        return on_host ? 1 : static_cast<std::ptrdiff_t>(weight.stride(1));
    }
    KOKKOS_FUNCTION int entry_groups() const { return lane_groups(entries); }
    /// A group's entries and the rows of their grains; beyond the last entry the last again.
    KOKKOS_FORCEINLINE_FUNCTION void entries_of(int group, int (&entry)[lane_count], int (&row)[lane_count]) const
    {
        items_of_group(group, entries, entry);
        for (int n = 0; n < lane_count; ++n) row[n] = bins.item(entry[n]);
    }
    /// How many entries on memory is asked for, ahead of its use.
    KOKKOS_FUNCTION int ahead(int entry) const { return Kokkos::min(16, entries - 1 - entry); }
    /// Row of the grain there: those of neighbouring entries lie apart in memory.
    KOKKOS_FUNCTION int later_row(int entry) const { return bins.item(entry + ahead(entry)); }
};

/// position: [row](x, y, z, -), m. Grains whose centre is outside a non-periodic box are left out. The arrays of `spare` are
/// used again where they are large enough: weights that are not needed any more.
GrainWeights make_grain_weights(DepositStencil const& stencil, RecordView const& position, View1<GrainId> const& id,
                                int count, GrainWeights const& spare = {});

/// cell(c, q) = sum over entries of weight * quantity(entry, q), q < components (1 or 4), in fixed order.
/// quantity: [entry][components]; cell: [cell number][components].
void deposit(GrainWeights const& weights, TableView const& quantity, TableView const& cell, int components);

/// A table of cells [cell number][components, padded to whole Quads] for interpolate_at, which also reads a few rows
/// beyond the last cell, with weight 0.
inline TableView make_interpolated(std::string const& label, Grid const& grid, int components)
{
    return TableView(label, grid.cell_count() + DepositStencil::group - 1, (components + 3) / 4 * 4);
}

namespace deposit_detail {

/// Sums over a block of cells that lies whole in the box, `groups` groups of them in a row. weight: the entry's, `step` from
/// column to column.
template <int groups, int quads>
KOKKOS_FORCEINLINE_FUNCTION void sum_block(DepositStencil const& stencil, Real const* weight, std::ptrdiff_t step,
                                           int first_cell, TableView const& cell, RecordSum<quads>& sum)
{
    constexpr int count = groups * DepositStencil::group;
    Grid const& grid = stencil.grid;
    std::ptrdiff_t const stride = static_cast<std::ptrdiff_t>(cell.stride(0)), row = stride * grid.cells[0],
                         plane = row * grid.cells[1];
    Real const* const first = cell.data() + stride * first_cell;
    Real wx[count];
    for (int a = 0; a < count; ++a) wx[a] = weight[a * step];
    Real const *const wy = weight + stencil.y_slot() * step, *const wz = weight + stencil.z_slot() * step;
    for (int c = 0; c < stencil.slots[2]; ++c) {
        Real const* values = first + c * plane;
        for (int b = 0; b < stencil.slots[1]; ++b, values += row) {
            RecordSum<quads> along_x;
            for (int a = 0; a < count; ++a) along_x.add(wx[a], values + a * stride);
            sum.add(wy[b * step] * wz[c * step], along_x);
        }
    }
}

/// The same for any block, cell by cell: it may go on at a periodic box's other end.
template <int quads>
KOKKOS_FUNCTION void sum_any_block(DepositStencil const& stencil, Real const* weight, std::ptrdiff_t step,
                                   int const (&start)[3], TableView const& cell, RecordSum<quads>& sum)
{
    for (int c = 0; c < stencil.slots[2]; ++c)
        for (int b = 0; b < stencil.slots[1]; ++b) {
            int const row = stencil.cell(1, start[1], b) + stencil.grid.cells[1] * stencil.cell(2, start[2], c);
            Real const wyz = weight[(stencil.y_slot() + b) * step] * weight[(stencil.z_slot() + c) * step];
            for (int a = 0; a < stencil.slots[0]; ++a) {
                Real const* const values = &cell(stencil.grid.cells[0] * row + stencil.cell(0, start[0], a), 0);
                sum.add(wyz * weight[a * step], values);
            }
        }
}

/// The same for entries of one block, an entry a lane. weight: [column].
template <int groups, int components>
KOKKOS_FORCEINLINE_FUNCTION void sum_block(DepositStencil const& stencil, Lanes const* weight, int first_cell,
                                           TableView const& cell, Lanes (&sum)[components])
{
    constexpr int count = groups * DepositStencil::group;
    std::ptrdiff_t const stride = static_cast<std::ptrdiff_t>(cell.stride(0)), row = stride * stencil.grid.cells[0],
                         plane = row * stencil.grid.cells[1];
    Real const* const first = cell.data() + stride * first_cell;
    for (int q = 0; q < components; ++q) sum[q] = 0;
    for (int c = 0; c < stencil.slots[2]; ++c) {
        Real const* values = first + c * plane;
        for (int b = 0; b < stencil.slots[1]; ++b, values += row) {
            Lanes const across = weight[stencil.y_slot() + b] * weight[stencil.z_slot() + c];
            for (int q = 0; q < components; ++q) {
                Lanes along_x = weight[0] * values[q];
                for (int a = 1; a < count; ++a) along_x += weight[a] * values[a * stride + q];
                sum[q] += across * along_x;
            }
        }
    }
}

} // namespace deposit_detail

/// One entry's mean of the cells' values, the adjoint of deposit: sum over cells of weight * cell(c, q).
/// cell: made by make_interpolated for as many components or more.
template <int components>
KOKKOS_FORCEINLINE_FUNCTION void interpolate_at(GrainWeights const& weights, int entry, TableView const& cell,
                                                Real (&value)[components])
{
    DepositStencil const& stencil = weights.stencil;
    int const first = weights.first_cell(entry);
    Real const* const weight = &weights.weight(entry, 0);
    std::ptrdiff_t const step = weights.column_step();
    RecordSum<(components + 3) / 4> sum;
    if (first >= 0 && stencil.groups == 1) deposit_detail::sum_block<1>(stencil, weight, step, first, cell, sum);
    else if (first >= 0 && stencil.groups == 2) deposit_detail::sum_block<2>(stencil, weight, step, first, cell, sum);
    else {
        int const code = first >= 0 ? first : -1 - first;
        int const nx = first >= 0 ? stencil.grid.cells[0] : stencil.starts[0],
                  ny = first >= 0 ? stencil.grid.cells[1] : stencil.starts[1];
        deposit_detail::sum_any_block(stencil, weight, step, {code % nx, code / nx % ny, code / (nx * ny)}, cell, sum);
    }
    for (int q = 0; q < components; ++q) value[q] = sum[q];
}

/// The same for a group of entries (GrainWeights::entries_of), an entry a lane.
template <int components>
KOKKOS_FORCEINLINE_FUNCTION void interpolate_at(GrainWeights const& weights, int const (&entry)[lane_count],
                                                TableView const& cell, Lanes (&value)[components])
{
    if constexpr (lane_count > 1) {
        DepositStencil const& stencil = weights.stencil;
        constexpr int most_columns = 24; // of two groups of x and as many slots of y and z
        int const first = weights.first_cell(entry[0]), columns = stencil.columns();
        // Entries are sorted by block, so all are of one if the first and the last are.
        if (first >= 0 && first == weights.first_cell(entry[lane_count - 1]) && columns <= most_columns &&
            stencil.groups <= 2) {
            Lanes weight[most_columns];
            for (int column = 0; column < columns; column += 4) {
                LaneRecords const four = turned([&](int n) { return load_quad(&weights.weight(entry[n], column)); });
                for (int k = 0; k < 3; ++k) weight[column + k] = four.xyz[k];
                weight[column + 3] = four.w;
            }
            if (stencil.groups == 1) deposit_detail::sum_block<1>(stencil, weight, first, cell, value);
            else deposit_detail::sum_block<2>(stencil, weight, first, cell, value);
            return;
        }
    }
    Real numbers[components][lane_count];
    for (int n = 0; n < lane_count; ++n) {
        Real of_entry[components];
        interpolate_at(weights, entry[n], cell, of_entry);
        for (int q = 0; q < components; ++q) numbers[q][n] = of_entry[q];
    }
    for (int q = 0; q < components; ++q) value[q] = load_lanes(numbers[q]);
}

} // namespace arenite
