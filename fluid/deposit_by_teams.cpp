// SPDX-License-Identifier: MIT
#include "fluid/deposit_by_teams.hpp"

#include "core/error.hpp"
#include "core/work_array.hpp"

#include <algorithm>

namespace arenite {
namespace {

// All of them are part of the result's definition.
constexpr int chunk_entries = 256;
constexpr int rows_of_team = 16, lanes_of_team = 8; // of threads, while a chunk is summed
constexpr int team = rows_of_team * lanes_of_team;
constexpr int lanes_of_cell = 16;             // threads a component, while a cell's sum is added up
constexpr long long chunk_limit = 16'000'000; // reals (128 MB) of sums of chunks held at once

// Threads of a team. On a host, where only tests come, one does what a team would.
constexpr int sum_threads = on_host ? 1 : team;
template <int components> constexpr int cell_threads = on_host ? 1 : lanes_of_cell * components;

using Scratch = Kokkos::View<Real*, ExecutionSpace::scratch_memory_space, Kokkos::MemoryUnmanaged>;

/// A block's cells as the sums see them: rows of a group of four along x.
struct BlockRows {
    DepositStencil stencil;

    KOKKOS_FUNCTION int count() const { return stencil.groups * stencil.slots[1] * stencil.slots[2]; }
    KOKKOS_FUNCTION int number(int group, int b, int c) const
    {
        return (group * stencil.slots[2] + c) * stencil.slots[1] + b;
    }
    KOKKOS_FUNCTION int slot_y(int row) const { return row % stencil.slots[1]; }
    KOKKOS_FUNCTION int slot_z(int row) const { return row / stencil.slots[1] % stencil.slots[2]; }
    KOKKOS_FUNCTION int group(int row) const { return row / (stencil.slots[1] * stencil.slots[2]); }
};

/// Sums of one row: of 4 components a Quad a cell; of one, a Quad for its cells.
template <int components> struct RowSum {
    static_assert(DepositStencil::group == 4 && (components == 1 || components == 4));
    static constexpr int numbers = DepositStencil::group * components;
    Quad sum[components] = {};

    /// Every `stride`-th entry of first .. last - 1.
    KOKKOS_FORCEINLINE_FUNCTION void add(GrainWeights const& weights, BlockRows const& rows, int row,
                                         TableView const& quantity, int first, int last, int stride)
    {
        DepositStencil const& stencil = weights.stencil;
        std::ptrdiff_t const step = weights.column_step();
        Real const* const w = weights.weight.data();
        Real const *const wx = w + step * DepositStencil::group * rows.group(row),
                          *const wy = w + step * (stencil.y_slot() + rows.slot_y(row)),
                          *const wz = w + step * (stencil.z_slot() + rows.slot_z(row));
        std::ptrdiff_t const entry_step = weights.entry_step();
        for (int entry = first; entry < last; entry += stride) {
            std::ptrdiff_t const at = entry_step * entry;
            Real const wyz = wy[at] * wz[at];
            Quad const along_x{wx[at], wx[at + step], wx[at + 2 * step], wx[at + 3 * step]};
            if constexpr (components == 1) sum[0] += (wyz * quantity(entry, 0)) * along_x;
            else {
                Quad const share = wyz * load_record(&quantity(entry, 0));
                for (int a = 0; a < components; ++a) sum[a] += along_x[a] * share;
            }
        }
    }
};

/// partial: [chunk - first_chunk][row of the block][slot of x in the group][component].
template <int components>
void sum_chunks(GrainWeights const& weights, TableView const& quantity, int first_chunk, int chunks)
{
    using Sum = RowSum<components>;
    constexpr int pitch = team + 1; // of numbers in the scratch; odd, so that its banks are met in turn
    DepositChunks const table = weights.chunks;
    BlockRows const rows{weights.stencil};
    View1<Real> const partial = table.partial;
    int const batches = (rows.count() + rows_of_team - 1) / rows_of_team; // of rows, a team each
    TeamPolicy policy(chunks * batches, sum_threads);
    policy.set_scratch_size(0, Kokkos::PerTeam(Scratch::shmem_size(Sum::numbers * pitch)));
    Kokkos::parallel_for(
        "sum_chunks", policy, KOKKOS_LAMBDA(TeamPolicy::member_type const& member) {
            Scratch const scratch(member.team_scratch(0), Sum::numbers * pitch);
            int const chunk = first_chunk + member.league_rank() / batches;
            int const first_row = member.league_rank() % batches * rows_of_team;
            int const block = table.block(chunk);
            int const first = weights.begin(block) + chunk_entries * (chunk - table.begin(block));
            int const last = Kokkos::min(first + chunk_entries, weights.begin(block + 1));
            for (int thread = member.team_rank(); thread < team; thread += sum_threads) {
                Sum sum;
                int const row = first_row + thread % rows_of_team;
                if (row < rows.count())
                    sum.add(weights, rows, row, quantity, first + thread / rows_of_team, last, lanes_of_team);
                for (int n = 0; n < Sum::numbers; ++n) scratch(n * pitch + thread) = sum.sum[n / 4][n % 4];
            }
            member.team_barrier();
            int const rows_left = rows.count() - first_row;
            int const wanted = Sum::numbers * (rows_left < rows_of_team ? rows_left : rows_of_team);
            Real* const to = &partial(static_cast<std::size_t>(Sum::numbers) *
                                      (static_cast<std::size_t>(chunk - first_chunk) * rows.count() + first_row));
            for (int which = member.team_rank(); which < wanted; which += sum_threads) {
                Real const* const from = &scratch(which % Sum::numbers * pitch + which / Sum::numbers);
                Real total = 0;
                for (int lane = 0; lane < lanes_of_team; ++lane) total += from[lane * rows_of_team];
                to[which] = total;
            }
        });
}

/// Cells' sums of these chunks: the first of them, or on top of those before.
template <int components> void add_chunks(GrainWeights const& weights, TableView const& cell, int first_chunk, int chunks)
{
    constexpr int numbers = RowSum<components>::numbers, threads = lanes_of_cell * components;
    DepositStencil const stencil = weights.stencil;
    DepositChunks const table = weights.chunks;
    BlockRows const rows{stencil};
    int const touching = stencil.slots[0] * stencil.slots[1] * stencil.slots[2];
    View1<Real> const partial = table.partial;
    TeamPolicy policy(stencil.grid.cell_count(), cell_threads<components>);
    policy.set_scratch_size(0, Kokkos::PerTeam(Scratch::shmem_size(threads)));
    Kokkos::parallel_for(
        "add_chunks", policy, KOKKOS_LAMBDA(TeamPolicy::member_type const& member) {
            Scratch const scratch(member.team_scratch(0), threads);
            Grid const& grid = stencil.grid;
            int const number = member.league_rank(), i = number % grid.cells[0], j = number / grid.cells[0] % grid.cells[1],
                      k = number / (grid.cells[0] * grid.cells[1]);
            for (int thread = member.team_rank(); thread < threads; thread += cell_threads<components>) {
                int const q = thread % components;
                Real total = 0;
                // The blocks that have the cell, by its place in them.
                for (int n = thread / components; n < touching; n += lanes_of_cell) {
                    int const slot = n % stencil.slots[0], b = n / stencil.slots[0] % stencil.slots[1],
                              c = n / (stencil.slots[0] * stencil.slots[1]);
                    int const sx = stencil.start(0, i, slot), sy = stencil.start(1, j, b), sz = stencil.start(2, k, c);
                    if (sx < 0 || sy < 0 || sz < 0) continue;
                    int const block = stencil.block(sx, sy, sz);
                    int const begin = Kokkos::max(table.begin(block) - first_chunk, 0),
                              end = Kokkos::min(table.begin(block + 1) - first_chunk, chunks);
                    std::size_t const step = static_cast<std::size_t>(numbers) * rows.count();
                    Real const* from = partial.data() + step * begin +
                                       numbers * rows.number(slot / DepositStencil::group, b, c) +
                                       slot % DepositStencil::group * components + q;
                    for (int chunk = begin; chunk < end; ++chunk, from += step) total += *from;
                }
                scratch(thread) = total;
            }
            member.team_barrier();
            for (int q = member.team_rank(); q < components; q += cell_threads<components>) {
                Real total = first_chunk == 0 ? 0 : cell(number, q);
                for (int lane = 0; lane < lanes_of_cell; ++lane) total += scratch(lane * components + q);
                cell(number, q) = total;
            }
        });
}

long long partial_of_chunk(DepositStencil const& stencil, int components)
{
    return 1LL * BlockRows{stencil}.count() * DepositStencil::group * components;
}

int chunks_at_once(DepositStencil const& stencil, int chunks, int components)
{
    return static_cast<int>(
        std::clamp<long long>(chunk_limit / partial_of_chunk(stencil, components), 1, std::max(1, chunks)));
}

template <int components> void deposit_chunks(GrainWeights const& weights, TableView const& quantity, TableView const& cell)
{
    int const at_once = chunks_at_once(weights.stencil, weights.chunks.count, components);
    // Cells are written without a grain, too.
    for (int first = 0; first == 0 || first < weights.chunks.count; first += at_once) {
        int const chunks = std::min(at_once, weights.chunks.count - first);
        sum_chunks<components>(weights, quantity, first, chunks);
        add_chunks<components>(weights, cell, first, chunks);
    }
}

} // namespace

DepositChunks make_deposit_chunks(GrainWeights const& weights, DepositChunks const& spare)
{
    DepositChunks chunks = spare;
    int const blocks = weights.stencil.block_count();
    int const most = std::min(blocks, weights.entries) + weights.entries / chunk_entries;
    fit(chunks.begin, "deposit_chunk_begin", blocks + 1);
    fit(chunks.block, "deposit_chunk_block", most);
    View1<int> const begin = chunks.begin, block_of = chunks.block;
    Kokkos::parallel_scan(
        "make_deposit_chunks", RangePolicy(0, blocks + 1),
        KOKKOS_LAMBDA(int block, int& offset, bool last) {
            int const entries = block < blocks ? weights.begin(block + 1) - weights.begin(block) : 0;
            int const count = (entries + chunk_entries - 1) / chunk_entries;
            if (last) {
                begin(block) = offset;
                for (int n = 0; n < count; ++n) block_of(offset + n) = block;
            }
            offset += count;
        },
        chunks.count);
    long long partial = 0;
    for (int const components : {1, 4})
        partial = std::max(partial, chunks_at_once(weights.stencil, chunks.count, components) *
                                        partial_of_chunk(weights.stencil, components));
    fit(chunks.partial, "deposit_chunk_sums", partial);
    return chunks;
}

void deposit_by_teams(GrainWeights const& weights, TableView const& quantity, TableView const& cell, int components)
{
    ARENITE_REQUIRE(components == 1 || components == 4, "deposit is built for 1 and 4 components");
    if (components == 1) deposit_chunks<1>(weights, quantity, cell);
    else deposit_chunks<4>(weights, quantity, cell);
}

} // namespace arenite
