// SPDX-License-Identifier: MIT
// A step in parts. With more grains than the caches hold, what the contacts of all grains write would be back in memory
// before the grains gather it. So a host evaluates the contacts of some tiles of grains (core/contact_list.hpp) and moves
// those grains at once, tile after tile. A pair across tiles is evaluated with the earlier of its tiles if its first grain
// lies there, else before any grain moves. The force rows of close pairs within a tile lie where those of the tile before
// lay: they are written to and read from the caches alone. A contact is evaluated and a grain summed up exactly as in one
// part, so the bits are the same.
#pragma once

#include "core/contact_list.hpp"
#include "core/lanes.hpp"

#include <algorithm>

namespace arenite {

/// Blocks of lane_count contacts that hold all.
inline int blocks_of(ContactList const& list) { return lane_groups(list.count); }

/// From one to before another.
struct Range {
    int begin = 0, end = 0;
};

/// Where the force rows of a pass are in ContactList::force: those of `count` contacts from `begin` on, a whole number of
/// blocks, are shifted to the rows that all passes share.
struct SharedRows {
    int begin = 0, count = 0, shift = 0;

    /// Without a branch: contacts across tiles are anywhere among the others.
    KOKKOS_FORCEINLINE_FUNCTION int operator()(int contact) const
    {
        bool const shares = static_cast<unsigned>(contact - begin) < static_cast<unsigned>(count);
        return contact + (-static_cast<int>(shares) & shift);
    }
    /// The same of incident entries, two a contact.
    SharedRows of_entries() const { return {2 * begin, 2 * count, 2 * shift}; }
};

/// A part of a step: blocks of contacts to evaluate, then the grains to move, whose contacts are evaluated by then.
struct ContactPass {
    Range close, close_across, others; // blocks
    Range grains;                      // rows
    SharedRows force_row;              // of a contact
    bool last = true;
};

/// The step in one part.
inline ContactPass whole_step(ContactList const& list)
{
    int const blocks = blocks_of(list), close = std::min(blocks, lane_groups(list.close));
    ContactPass pass;
    pass.close = {0, close};
    pass.others = {close, blocks};
    pass.grains = {0, list.grains()};
    return pass;
}

/// Of a list with tiles, in a host's memory: the blocks of its tiles. A block across two tiles goes with the first of them.
/// One with contacts of two sections goes with those that are evaluated before any grain moves.
struct TileBlocks {
    ContactList const& list;
    Range within, up, others; // blocks of these sections alone

    explicit TileBlocks(ContactList const& tiled) : list(tiled)
    {
        within = blocks_within(Section::close_within, 0);
        up = blocks_within(Section::close_up, within.end);
        others = blocks_within(Section::others_up, up.end);
    }

    /// First contact that a tile's grains, or those of later tiles, own in a section.
    int begin_of(int section, int tile) const { return list.row_begin(section * list.grains() + first_grain(tile)); }
    int first_grain(int tile) const
    {
        return static_cast<int>(std::min(1LL * tile * list.tile_grains, 1LL * list.grains()));
    }
    Range blocks_within(int section, int from) const
    {
        int const begin = std::max(from, lane_groups(begin_of(section, 0)));
        return {begin, std::max(begin, begin_of(section + 1, 0) / lane_count)};
    }
    Range of_tiles(int section, Range const& all, int first, int end) const
    {
        auto const begin = [&](int tile) { return std::clamp(lane_groups(begin_of(section, tile)), all.begin, all.end); };
        return {begin(first), begin(end)};
    }

    /// What is evaluated before any grain moves.
    ContactPass beforehand() const
    {
        ContactPass pass;
        pass.close = {within.end, up.begin};
        pass.close_across = {up.end, others.begin};
        pass.others = {others.end, blocks_of(list)};
        pass.last = false;
        return pass;
    }

    ContactPass pass_of(int first, int end) const
    {
        ContactPass pass;
        pass.close = of_tiles(Section::close_within, within, first, end);
        pass.close_across = of_tiles(Section::close_up, up, first, end);
        pass.others = of_tiles(Section::others_up, others, first, end);
        pass.grains = {first_grain(first), first_grain(end)};
        int const full = std::clamp(begin_of(Section::close_within, end) / lane_count, pass.close.begin, pass.close.end),
                  shared = pass.close.begin * lane_count;
        pass.force_row = {shared, full * lane_count - shared, list.touching.extent_int(0) - shared};
        pass.last = pass.grains.end == list.grains();
        return pass;
    }
};

/// Calls visit(pass) for the parts of a step, one after the other, each of `together` tiles.
template <class Visit> void for_each_pass(ContactList const& list, int together, Visit const& visit)
{
    if (!on_host || list.tile_grains == 0) return visit(whole_step(list));
    if constexpr (on_host) {
        TileBlocks const blocks(list);
        visit(blocks.beforehand());
        for (int tile = 0; blocks.first_grain(tile) < list.grains(); tile += together)
            visit(blocks.pass_of(tile, tile + together));
    }
}

/// As a step is made: of a tile a thread.
template <class Visit> void for_each_pass(ContactList const& list, Visit const& visit)
{
    for_each_pass(list, ExecutionSpace().concurrency(), visit);
}

/// Rows of forces that the passes of a step share: as many as the richest of them asks for.
inline int shared_rows(ContactList const& list, int together)
{
    int rows = 0;
    for_each_pass(list, together, [&](ContactPass const& pass) { rows = std::max(rows, pass.force_row.count); });
    return rows;
}

} // namespace arenite
