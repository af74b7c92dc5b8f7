// SPDX-License-Identifier: MIT
// lane_count contacts as a kernel over contacts sees them: their grains' records, and the pairs of materials among them.
#pragma once

#include "core/contact_list.hpp"
#include "core/lanes.hpp"
#include "core/material.hpp"
#include "kernels/contact/normal_response.hpp"

#include <algorithm>

namespace arenite {

/// Blocks of lane_count contacts that hold them all.
inline int blocks_of(ContactList const& list) { return (list.count + lane_count - 1) / lane_count; }

/// How the threads of a host share the blocks of a list. Close contacts are first in it and cost several times what the
/// others do: both kinds come in turns, in proportion and each in its order, so that threads with as many turns have as much
/// to do. On a device a turn is one block, and they come as they are.
struct BlockTurns {
    int blocks = 0, length = 1, count = 0; // length: blocks of a turn

    BlockTurns(ContactList const& list, int on_host_length)
        : blocks(blocks_of(list)), length(on_host ? std::max(1, on_host_length) : 1), count((blocks + length - 1) / length)
    {
    }
    /// Long turns, 16 a thread: the streams through memory begin anew with each.
    explicit BlockTurns(ContactList const& list) : BlockTurns(list, length_for(list, ExecutionSpace().concurrency())) {}

    static int length_for(ContactList const& list, int threads)
    {
        return threads == 1 ? blocks_of(list) : std::max(8, blocks_of(list) / (16 * threads));
    }

    /// First block of the k-th turn.
    KOKKOS_FORCEINLINE_FUNCTION int begin(ContactList const& list, int k) const
    {
        if constexpr (!on_host) return k;
        int const close = list.close / (length * lane_count), others = count - close;
        long long const share = static_cast<long long>(k) * others;
        int const before = static_cast<int>(share / count); // turns of others among those before k
        return length * (share % count + others >= count ? close + before : k - before);
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
