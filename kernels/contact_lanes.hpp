// SPDX-License-Identifier: MIT
// lane_count contacts as a kernel over contacts sees them: their grains' records, and the pairs of materials among them.
#pragma once

#include "core/contact_list.hpp"
#include "core/lanes.hpp"
#include "core/material.hpp"

namespace arenite {

/// Blocks of lane_count contacts that hold them all.
inline int blocks_of(ContactList const& list) { return (list.count + lane_count - 1) / lane_count; }

KOKKOS_FORCEINLINE_FUNCTION LaneRecords records_of(RecordView const& view, int const* grains)
{
    return load_records(view.data(), grains);
}

/// Asks for what a kernel over contacts reads of the second grains some blocks ahead: partners lie apart in memory, where
/// the processor does not see them coming. second: of the first contact of a block.
template <class... Records> KOKKOS_FORCEINLINE_FUNCTION void ask_for_later(int const* second, Records const&... of)
{
    if constexpr (lane_count > 1)
        for (int n = second_ahead - lane_count; n < second_ahead; ++n)
            (prefetch(of.data() + 4 * static_cast<std::ptrdiff_t>(second[n])), ...);
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
