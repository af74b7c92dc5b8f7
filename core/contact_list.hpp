// SPDX-License-Identifier: MIT
// The pairs of grains that touch or are close to, with what each contact remembers. Contact-centric: a pair
// is evaluated once and writes its force into its own row; a grain gathers its rows in the order of its
// partners' ids. So the bits depend on ids and positions only, not on threads, on how the grains happen
// to be sorted, or on when the list was built. (A grain that left by a periodic face is put back at the next
// search, which rounds its position: in a periodic box the time of a search shows in the last bits.)
//
// Pairs that touched or all but touched when the list was built (close_share of the skin) come first, by grain; then all
// others, by grain. So the kernel seldom meets both kinds in one block, and blocks of the second kind cost next to nothing.
// Likewise a grain gathers the others, in between by partner id, only once one of them has carried a force: until then its
// sum is the same without their zeros.
//
// A host that has more grains than its caches hold takes the step in parts (kernels/contact_passes.hpp). For it the grains
// lie in tiles, so many rows each, and the pairs that it evaluates together lie together (Section).
//
// The first grain of a pair owns the row: the smaller of the two, of equal ones that with the lower id. That
// depends on the two alone, so memory stays with its row whatever other grains come or leave. The normal
// points from second to first.
#pragma once

#include "core/periodic_box.hpp"
#include "core/types.hpp"

namespace arenite {

/// What a contact law wants remembered; what it does not want is not allocated.
struct ContactNeeds {
    bool history = false;        // a tangential spring
    bool bonds = false;          // adhering contacts
    bool contact_radius = false; // of the last step, which some tangential laws compare with
};

/// One row of forces is 64 bytes: force on first (x, y, z), arm of first; normal x force (x, y, z), arm of second.
using ForceRows = Kokkos::View<Real* [8], Kokkos::LayoutRight, MemorySpace>;

/// One column per component, so that neighbouring contacts are read together.
template <int components> using ContactColumns = Kokkos::View<Real* [components], Kokkos::LayoutLeft, MemorySpace>;

/// The kernel takes several contacts at a time (core/lanes.hpp), so what has a row per contact has a multiple of this.
/// The rows beyond the last contact name grain 0 twice; their results go nowhere.
inline constexpr int contact_block = 8;

/// Pairs with a gap below this share of the skin count as close. Stretched bonds are among them: they hold to
/// 1e-3 of a radius.
inline constexpr Real close_share = 0.02;

/// Second grains that may be read beyond the last contact: the kernel asks early for the records to come.
inline constexpr int second_ahead = 24;

/// Incident entries that may be read beyond the last: a gather asks early for the rows to come.
inline constexpr int incident_ahead = 32;

/// How pairs are sorted: in this order, within a section by the first grain's row.
struct Section {
    enum : int {
        close = 0, // without tiles these two
        others = 1,
        close_within = 0, // with tiles these: of grains of one tile
        close_up = 1,     // the first grain's tile is before the second's
        close_down = 2,   // after it
        others_up = 3,    // not close; the first grain's tile is not after the second's
        others_down = 4,
        most = 5
    };
};

struct ContactList {
    int count = 0;       // pairs within the cutoff
    int close = 0;       // the first of them, which were close
    int tile_grains = 0; // grains of a tile; 0: the list has no tiles
    ContactNeeds needs;
    bool periodic = false;

    View1<int> row_begin;      // [sections() * grain + 1] contacts that grain i owns, those of section s at s grains() + i
    View1<int> first;          // [contact] rows of the two grains
    View1<int> second;         // [contact + second_ahead]
    View1<std::uint8_t> image; // [contact] image code of second; empty in a closed box
    ContactColumns<2> scale;   // [contact](R* m, m* kg)
    View1<Real> inverse_cube_root; // [contact] R*^(-1/3) m^(-1/3); empty without bonds
    View1<std::uint8_t> touching;  // [contact] carried a force at the last evaluation
    View1<std::uint8_t> adhering;  // [contact] follows the JKR curve; empty without bonds
    ContactColumns<3> spring;      // [contact](xi x, y, z m); empty without history
    View1<Real> contact_radius;    // [contact] a at the last evaluation, m; empty unless needed
    ForceRows force;               // [contact] N and m, none where not touching; then, with tiles, rows that passes share

    View1<int> incident_begin; // [2 grain + 1] a grain's close contacts at i, its others at grains() + i
    View1<int> incident;       // [2 contact + incident_ahead] contact * 2 + (1 where the grain is second), by partner id
    View1<std::uint8_t> incident_place; // [2 others] how many of the grain's close contacts have a partner of lower id
    View1<std::uint8_t> awake;          // [grain] 1 once one of its others has carried a force, else 0

    RecordView reference_position; // [grain] where the grains were when the list was built

    KOKKOS_FUNCTION int sections() const { return tile_grains > 0 ? Section::most : 2; }
    KOKKOS_FUNCTION int close_sections() const { return tile_grains > 0 ? Section::others_up : Section::others; }
    KOKKOS_FUNCTION int grains() const { return row_begin.extent_int(0) / sections(); }

    /// The row of a contact that does not touch may hold a force: of an earlier step, or of another contact of its pass.
    KOKKOS_FUNCTION bool rows_may_be_old(int contact) const { return tile_grains > 0 && contact < close; }
};

/// A grain with more close contacts than incident_place can tell has all its contacts in the list of the close ones.
inline constexpr int most_places = 255;

/// Calls visit(contact) for the contacts that grain i owns.
template <class Visit> KOKKOS_FUNCTION void for_each_owned(ContactList const& list, int i, Visit const& visit)
{
    for (int row = i; row < list.sections() * list.grains(); row += list.grains())
        for (int c = list.row_begin(row); c < list.row_begin(row + 1); ++c) visit(c);
}

/// From the second grain of a contact, or its image, to the first, m.
KOKKOS_INLINE_FUNCTION Vec3 contact_offset(ContactList const& list, RecordView const& position, PeriodicBox const& box,
                                           int c)
{
    Vec3 const offset = vector_of(position, list.first(c)) - vector_of(position, list.second(c));
    return list.periodic ? offset - box.image_shift(list.image(c)) : offset;
}

} // namespace arenite
