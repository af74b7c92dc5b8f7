// SPDX-License-Identifier: MIT
// lane_count contacts as a kernel over contacts sees them: their grains' records, and the pairs of materials among them.
#pragma once

#include "core/material.hpp"
#include "kernels/contact/normal_response.hpp"
#include "kernels/contact_passes.hpp"

#include <algorithm>

namespace arenite {

/// How the threads of a host share the blocks of a pass. Its close contacts cost several times what the others do: both
/// kinds come in turns, in proportion and each in its order, so that threads with as many turns have as much to do. On a
/// device a turn is one block, and they come as they are.
struct BlockTurns {
    Range close, close_across, others;                      // blocks
    int length = 1;                                         // blocks of a turn
    int close_turns = 0, across_turns = 0, other_turns = 0; // how many
    int count = 0;                                          // in all

    BlockTurns(ContactPass const& pass, int on_host_length)
        : close(pass.close), close_across(pass.close_across), others(pass.others),
          length(on_host ? std::max(1, on_host_length) : 1)
    {
        auto const turns_of = [&](Range const& blocks) { return (blocks.end - blocks.begin + length - 1) / length; };
        close_turns = turns_of(close);
        across_turns = turns_of(close_across);
        other_turns = turns_of(others);
        count = close_turns + across_turns + other_turns;
    }
    /// Long turns, 16 a thread: the streams through memory begin anew with each.
    explicit BlockTurns(ContactPass const& pass) : BlockTurns(pass, length_for(pass, ExecutionSpace().concurrency())) {}

    static int length_for(ContactPass const& pass, int threads)
    {
        auto const size = [](Range const& blocks) { return blocks.end - blocks.begin; };
        int const blocks = size(pass.close) + size(pass.close_across) + size(pass.others);
        return threads == 1 ? blocks : std::max(8, blocks / (16 * threads));
    }

    /// Blocks of the k-th turn.
    KOKKOS_FORCEINLINE_FUNCTION Range operator()(int k) const
    {
        if constexpr (!on_host) return {k, k + 1};
        long long const share = static_cast<long long>(k) * other_turns;
        int const before = static_cast<int>(share / count); // turns of others among those before k
        if (share % count + other_turns >= count) return turn_of(others, before);
        int const n = k - before;
        return n < close_turns ? turn_of(close, n) : turn_of(close_across, n - close_turns);
    }

    KOKKOS_FORCEINLINE_FUNCTION Range turn_of(Range const& blocks, int n) const
    {
        int const begin = blocks.begin + length * n;
        return {begin, Kokkos::min(begin + length, blocks.end)};
    }
};

KOKKOS_FORCEINLINE_FUNCTION LaneRecords records_of(RecordView const& view, int const* grains)
{
    return load_records(view.data(), grains);
}

/// Asks for what these arrays hold of a grain.
template <class... Records> KOKKOS_FORCEINLINE_FUNCTION void ask_for_grain(int row, Records const&... of)
{
    (prefetch(of.data() + 4 * static_cast<std::ptrdiff_t>(row)), ...);
}

/// Asks for what a kernel over contacts reads of the second grains some blocks ahead: partners lie apart in memory, where
/// the processor does not see them coming. second: of the first contact of a block.
template <class... Records> KOKKOS_FORCEINLINE_FUNCTION void ask_for_later(int const* second, Records const&... of)
{
    if constexpr (lane_count > 1)
        for (int n = second_ahead - lane_count; n < second_ahead; ++n) ask_for_grain(second[n], of...);
}

/// Sizes of contacts c .. c + lane_count - 1. Without bonds no law asks for the inverse cube root, and the list has none.
template <bool bonds> KOKKOS_FORCEINLINE_FUNCTION ContactScale<Lanes> load_scale(ContactList const& list, int c)
{
    ContactScale<Lanes> scale{load_lanes(&list.scale(c, 0)), load_lanes(&list.scale(c, 1)), 0};
    if constexpr (bonds) scale.inverse_cube_root = load_lanes(&list.inverse_cube_root(c));
    return scale;
}

/// Of the second grains' images, m; contacts c .. c + lane_count - 1 of a list in a periodic box.
KOKKOS_FORCEINLINE_FUNCTION Vector<Lanes> image_shifts(ContactList const& list, PeriodicBox const& box, int c)
{
    Vec3 shift[lane_count];
    for (int n = 0; n < lane_count; ++n) shift[n] = box.image_shift(list.image(c + n));
    return {make_lanes([&](int n) { return shift[n].x; }), make_lanes([&](int n) { return shift[n].y; }),
            make_lanes([&](int n) { return shift[n].z; })};
}

/// Calls evaluate(constants, mask of the lanes that have them) for every pair of materials in the lanes: a law knows one
/// pair at a time. index: of each lane's pair.
template <class Evaluate>
KOKKOS_FORCEINLINE_FUNCTION void for_each_material_pair(PairTable const& pairs, int const (&index)[lane_count],
                                                        Evaluate const& evaluate)
{
    if constexpr (lane_count == 1) evaluate(pairs(index[0]), LaneMask(true));
    else
        for (int n = 0; n < lane_count; ++n) {
            bool done = false;
            for (int m = 0; m < n; ++m) done = done || index[m] == index[n];
            if (!done)
                evaluate(pairs(index[n]),
                         make_lanes([&](int m) { return static_cast<Real>(index[m] == index[n]); }) > Lanes(0));
        }
}

/// Of two grains each; i, j: rows of the lanes' grains.
template <class Evaluate>
KOKKOS_FORCEINLINE_FUNCTION void for_each_material_pair(PairTable const& pairs, View1<std::uint8_t> const& material,
                                                        int const* i, int const* j, Evaluate const& evaluate)
{
    int index[lane_count];
    for (int n = 0; n < lane_count; ++n) index[n] = pairs.index(material(i[n]), material(j[n]));
    for_each_material_pair(pairs, index, evaluate);
}

} // namespace arenite
