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

namespace arenite {

/// [item][component], component count chosen at run time.
using TableView = Kokkos::View<Real**, Kokkos::LayoutRight, MemorySpace>;

/// Extent of the weights: a grain touches `slots` cells along each axis, from its start cell on. Grains with
/// the same start cell share a block of cells. Near a wall, and in a box of fewer cells than slots, the
/// block is moved or cut so that it lies in the box.
struct DepositStencil {
    static constexpr int group = 4; // slots of x in a Quad; their storage is padded to it
    static constexpr int rows_at_once =
        lane_count > 1 ? 4 : 1; // slots of y that are summed at once: a GPU wants many small sums

    Grid grid;
    Real support_radius = 0;    // m
    int touched[3] = {1, 1, 1}; // most cells that the kernel touches on an axis without end
    int slots[3] = {1, 1, 1};   // cells of a block: touched, or the box's if these are fewer
    int starts[3] = {1, 1, 1};  // start cells 0 .. starts - 1
    int groups = 1;             // of x
    int row_groups = 1;         // of y, rows_at_once each

    KOKKOS_FUNCTION int y_slot() const { return group * groups; } // columns of GrainWeights::weight
    KOKKOS_FUNCTION int z_slot() const { return y_slot() + rows_at_once * row_groups; }
    KOKKOS_FUNCTION int columns() const { return z_slot() + slots[2]; }
    KOKKOS_FUNCTION int block_count() const { return starts[0] * starts[1] * starts[2]; }
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

/// The grains in the fluid's box, sorted by (block, bin in the block, id), and their weights. An entry is a
/// grain in that order. Bins keep the sort cheap when a block holds thousands of grains.
struct GrainWeights {
    DepositStencil stencil;
    int entries = 0;
    int bins_per_block = 1;
    CellList bins;    // bins.item: [entry] row of the grain
    View1<int> block; // [entry] start cell, as sx + starts_x (sy + starts_y sz)
    TableView weight; // [entry][slots of x, padded with 0; of y, likewise; of z]

    KOKKOS_FUNCTION int begin(int of_block) const { return bins.begin(of_block * bins_per_block); }
};

/// position: [row](x, y, z, -), m. Grains whose centre is outside a non-periodic box are left out. The arrays of `spare` are
/// used again where they are large enough: weights that are not needed any more.
GrainWeights make_grain_weights(DepositStencil const& stencil, RecordView const& position, View1<GrainId> const& id,
                                int count, GrainWeights const& spare = {});

/// cell(c, q) = sum over entries of weight * quantity(entry, q), q < components (1 or 4), in fixed order.
/// quantity: [entry][components]; cell: [cell number][components].
void deposit(GrainWeights const& weights, TableView const& quantity, TableView const& cell, int components);

/// Columns of a table of cells that interpolate_at reads: a cell's components go through whole Quads.
KOKKOS_FUNCTION constexpr int interpolated_columns(int components) { return (components + 3) / 4 * 4; }

/// One entry's mean of the cells' values, the adjoint of deposit: sum over cells of weight * cell(c, q).
/// cell: [cell number][interpolated_columns(components) or more].
template <int components>
KOKKOS_FUNCTION void interpolate_at(GrainWeights const& weights, int entry, TableView const& cell, Real (&value)[components])
{
    constexpr int quads = interpolated_columns(components) / 4;
    DepositStencil const& stencil = weights.stencil;
    int const block = weights.block(entry);
    int const i0 = block % stencil.starts[0];
    int const j0 = block / stencil.starts[0] % stencil.starts[1];
    int const k0 = block / (stencil.starts[0] * stencil.starts[1]);
    Real const* const wx = &weights.weight(entry, 0);
    Real const* const wy = &weights.weight(entry, stencil.y_slot());
    Real const* const wz = &weights.weight(entry, stencil.z_slot());
    std::ptrdiff_t const stride = static_cast<std::ptrdiff_t>(cell.stride(0));
    int const slots_x = stencil.slots[0], cells_x = stencil.grid.cells[0];
    int const before_end = i0 + slots_x <= cells_x ? slots_x : cells_x - i0; // the rest is at the periodic box's other end
    Quad sum[quads] = {};
    for (int c = 0; c < stencil.slots[2]; ++c) {
        int const k = stencil.cell(2, k0, c);
        for (int b = 0; b < stencil.slots[1]; ++b) {
            int const row = cells_x * (stencil.cell(1, j0, b) + stencil.grid.cells[1] * k);
            Quad along_x[quads] = {};
            auto const add = [&](int begin, int end, Real const* values) {
                for (int a = begin; a < end; ++a, values += stride)
                    for (int q = 0; q < quads; ++q) along_x[q] += wx[a] * load_quad(values + 4 * q);
            };
            add(0, before_end, cell.data() + (row + i0) * stride);
            add(before_end, slots_x, cell.data() + row * stride);
            Real const wyz = wy[b] * wz[c];
            for (int q = 0; q < quads; ++q) sum[q] += wyz * along_x[q];
        }
    }
    for (int q = 0; q < components; ++q) value[q] = sum[q / 4][q % 4];
}

} // namespace arenite
