// SPDX-License-Identifier: MIT
#include "fluid/deposit_by_blocks.hpp"

#include "core/error.hpp"
#include "core/turns.hpp"
#include "core/work_array.hpp"

#include <algorithm>

namespace arenite {
namespace {

constexpr long long partial_limit = 2'000'000; // reals (16 MB) of partial sums held at once

/// What the grains of one block give to some of its rows of cells: `group` cells each of rows_at_once rows, an independent
/// part of the deposit. A piece is what one row gets of it.
struct Part {
    int group = 0;              // of x
    int first_b = 0, c = 0;     // slots of y and z
    int sx = 0, sy = 0, sz = 0; // start cells
    int plane = -1;             // of cells that it gives to, from the first one on; -1: not among those that are wanted
};

/// Parts are numbered c, group of y, group, sx, sy, sz: those of a block follow each other, while its grains are in the
/// cache.
KOKKOS_FUNCTION Part part_of(DepositStencil const& stencil, int number, int first_plane, int planes)
{
    Part part;
    part.c = number % stencil.slots[2];
    number /= stencil.slots[2];
    part.first_b = DepositStencil::rows_at_once * (number % stencil.row_groups);
    number /= stencil.row_groups;
    part.group = number % stencil.groups;
    number /= stencil.groups;
    part.sx = number % stencil.starts[0];
    number /= stencil.starts[0];
    part.sy = number % stencil.starts[1];
    part.sz = number / stencil.starts[1];
    int const plane = stencil.cell(2, part.sz, part.c) - first_plane;
    if (plane >= 0 && plane < planes) part.plane = plane;
    return part;
}

/// Pieces are numbered group, start of x, b, c, target row.
KOKKOS_FUNCTION std::size_t piece_number(DepositStencil const& stencil, int row, int b, int c, int sx, int group)
{
    std::size_t const offset = (static_cast<std::size_t>(row) * stencil.slots[2] + c) * stencil.slots[1] + b;
    return (offset * stencil.starts[0] + sx) * stencil.groups + group;
}

/// A part of the deposit: sums of rows_at_once rows of `group` cells over the grains of its block. Of 4 components a row has
/// a Quad a cell; of one, a Quad for its cells.
template <int components> struct PartSum {
    static_assert(DepositStencil::group == 4 && (components == 1 || components == 4));
    static constexpr int rows = DepositStencil::rows_at_once, numbers = DepositStencil::group * components;
    Quad sum[rows][components] = {};

    KOKKOS_FORCEINLINE_FUNCTION void add(Real const* wx, Real const* wy, Real wz, Real const* quantity)
    {
        Quad share[components]; // of every row, but for its weight along y
        if constexpr (components == 1) share[0] = (wz * *quantity) * load_quad(wx);
        else {
            Quad const all = wz * load_quad(quantity);
            for (int a = 0; a < components; ++a) share[a] = wx[a] * all;
        }
        for (int r = 0; r < rows; ++r)
            for (int n = 0; n < components; ++n) sum[r][n] += wy[r] * share[n];
    }

    /// Over the block's entries.
    KOKKOS_FORCEINLINE_FUNCTION void add_entries(GrainWeights const& weights, Part const& part, TableView const& quantity)
    {
        DepositStencil const& stencil = weights.stencil;
        int const block = stencil.block(part.sx, part.sy, part.sz);
        int const first = weights.begin(block), last = weights.begin(block + 1);
        std::ptrdiff_t const columns = static_cast<std::ptrdiff_t>(weights.weight.stride(0));
        Real const* w = weights.weight.data() + first * columns;
        Real const* values =
            quantity.data() + static_cast<std::ptrdiff_t>(first) * components; // without grains there is no row
        int const x = DepositStencil::group * part.group, y = stencil.y_slot() + part.first_b, z = stencil.z_slot() + part.c;
        int const ahead = weights.ahead(last - 1); // for all of them
        for (int entry = first; entry < last; ++entry, w += columns, values += components) {
            prefetch(w + ahead * columns + x);
            prefetch(w + ahead * columns + z);
            prefetch(values + ahead * components);
            add(w + x, w + y, w[z], values);
        }
    }

    KOKKOS_FORCEINLINE_FUNCTION void write(DepositStencil const& stencil, Part const& part, Real* partial) const
    {
        for (int r = 0; r < rows && part.first_b + r < stencil.slots[1]; ++r) {
            int const b = part.first_b + r, target = stencil.cell(1, part.sy, b) + stencil.grid.cells[1] * part.plane;
            Real* const to = partial + numbers * piece_number(stencil, target, b, part.c, part.sx, part.group);
            for (int n = 0; n < numbers; ++n) to[n] = sum[r][n / 4][n % 4];
        }
    }
};

/// The pieces of all parts. A turn is a block's, whose grains stay in the cache; blocks at walls hold several times the
/// grains of others.
template <int components> void sum_parts(GrainWeights const& weights, TableView const& quantity, int first_plane, int planes)
{
    DepositStencil const stencil = weights.stencil;
    int const parts = stencil.groups * stencil.row_groups * stencil.slots[2]; // of a block
    for_each_turn(
        "deposit_parts", stencil.block_count(), KOKKOS_LAMBDA(int block) {
            for (int number = block * parts; number < (block + 1) * parts; ++number) {
                Part const part = part_of(stencil, number, first_plane, planes);
                if (part.plane < 0) continue;
                PartSum<components> sum;
                sum.add_entries(weights, part, quantity);
                sum.write(stencil, part, weights.partial.data());
            }
        });
}

/// A cell's sum of its pieces, in the order of (c, b, slot of x).
template <int components>
KOKKOS_FUNCTION void add_pieces(DepositStencil const& stencil, View1<Real> const& partial, int first_plane, int row, int i,
                                Real* total)
{
    constexpr int group = DepositStencil::group;
    int const j = row % stencil.grid.cells[1], k = first_plane + row / stencil.grid.cells[1];
    for (int q = 0; q < components; ++q) total[q] = 0;
    for (int c = 0; c < stencil.slots[2]; ++c) {
        if (stencil.start(2, k, c) < 0) continue;
        for (int b = 0; b < stencil.slots[1]; ++b) {
            if (stencil.start(1, j, b) < 0) continue;
            for (int slot = 0; slot < stencil.slots[0]; ++slot) {
                int const sx = stencil.start(0, i, slot);
                if (sx < 0) continue;
                std::size_t const piece = piece_number(stencil, row, b, c, sx, slot / group);
                Real const* const values = &partial(piece * group * components) + slot % group * components;
                for (int q = 0; q < components; ++q) total[q] += values[q];
            }
        }
    }
}

/// Reals of partial sums that a plane of cells takes.
long long partial_of_plane(DepositStencil const& stencil, int components)
{
    return 1LL * stencil.grid.cells[1] * stencil.slots[1] * stencil.slots[2] * stencil.starts[0] * stencil.groups *
           DepositStencil::group * components;
}

/// Planes of cells whose partial sums are held at once.
int planes_at_once(DepositStencil const& stencil, int components)
{
    return static_cast<int>(
        std::clamp<long long>(partial_limit / partial_of_plane(stencil, components), 1, stencil.grid.cells[2]));
}

/// Two passes over some planes of cells: the pieces, then the cells.
template <int components>
void deposit_planes(GrainWeights const& weights, TableView const& quantity, TableView const& cell, int first_plane,
                    int planes)
{
    DepositStencil const stencil = weights.stencil;
    View1<Real> const partial = weights.partial;
    int const nx = stencil.grid.cells[0], ny = stencil.grid.cells[1];
    sum_parts<components>(weights, quantity, first_plane, planes);
    Kokkos::parallel_for(
        "add_deposit_pieces", RangePolicy(0, ny * planes * nx), KOKKOS_LAMBDA(int target) {
            Real total[components];
            add_pieces<components>(stencil, partial, first_plane, target / nx, target % nx, total);
            int const number = nx * ny * first_plane + target;
            for (int q = 0; q < components; ++q) cell(number, q) = total[q];
        });
}

template <int components> void deposit_all(GrainWeights const& weights, TableView const& quantity, TableView const& cell)
{
    int const planes = planes_at_once(weights.stencil, components), all = weights.stencil.grid.cells[2];
    for (int first = 0; first < all; first += planes)
        deposit_planes<components>(weights, quantity, cell, first, std::min(planes, all - first));
}

} // namespace

void reserve_block_sums(GrainWeights& weights)
{
    long long partial = 0;
    for (int const components : {1, 4})
        partial =
            std::max(partial, planes_at_once(weights.stencil, components) * partial_of_plane(weights.stencil, components));
    fit(weights.partial, "deposit_partial", partial);
}

void deposit_by_blocks(GrainWeights const& weights, TableView const& quantity, TableView const& cell, int components)
{
    ARENITE_REQUIRE(components == 1 || components == 4, "deposit is built for 1 and 4 components");
    if (components == 1) deposit_all<1>(weights, quantity, cell);
    else deposit_all<4>(weights, quantity, cell);
}

} // namespace arenite
