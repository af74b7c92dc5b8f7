// SPDX-License-Identifier: MIT
// The grains that touch a wall or are close to one: one row per (grain, element of a wall), sorted by wall, grain id
// and element, so that what a wall feels is summed in an order of ids alone. A grain gathers its rows in the
// order of elements. Memory of a contact (spring, side, adhesion) is keyed by (grain id, element).
#pragma once

#include "core/material.hpp"
#include "core/particles.hpp"
#include "core/walls.hpp"
#include "kernels/integrate.hpp"

namespace arenite {

/// What kernels take.
struct WallContactRows {
    int count = 0; // rows
    ContactNeeds needs;

    View1<int> grain;             // [row] row of the grain
    View1<GrainId> id;            // [row] its id
    View1<int> element;           // [row] of the walls, numbered through all walls
    View1<std::uint8_t> touching; // [row] carried a force at the last evaluation
    View1<std::uint8_t> adhering; // [row] follows the JKR curve; empty without bonds
    RecordView normal;            // [row](unit normal at the last evaluation, side of a thin sheet or 0)
    RecordView spring;            // [row](xi x, y, z m, previous a m); empty without history
    ForceRows force;              // [row](F on the grain N, arm m, n x F N, normal stiffness N/m); 0 where not touching

    View1<int> begin;   // [grain + 1] into contact
    View1<int> contact; // [entry] rows of a grain by element
    View1<int> group;   // [group + 1] rows of one grain on one wall
    int groups = 0;
    View1<int> block, superblock; // [block + 1] rows of 64 and of 4096 ids on one wall: the order of sums
    int blocks = 0, superblocks = 0;
};

/// Force, torque, stiffness and impedance as WallReaction has them.
template <class Space> using WallSums = Kokkos::View<Real* [8], Kokkos::LayoutRight, Space>;

struct WallContacts : WallContactRows {
    std::vector<int> wall_of_superblock;
    WallSums<MemorySpace> block_sum;      // [block] where measure_walls works, kept from search to search
    WallSums<PinnedSpace> superblock_sum; // [superblock]
    std::vector<WallPose> reference_pose; // [wall] when the list was built; see wall_displacement
};

/// Rebuilds the list for gaps below skin, after the grains were sorted (rows may have changed, ids not). Rows that stay keep
/// their memory exactly. Between two searches the list holds as long as the farthest move of a grain and
/// wall_displacement(walls, contacts.reference_pose) add up to less than skin.
void search_wall_contacts(Particles const& particles, Walls const& walls, Real skin, ContactNeeds needs,
                          WallContacts& contacts);

/// Gives a list that came out of a checkpoint what follows from the grains' rows. Throws InputError for a contact of a
/// grain that is not there.
void complete_wall_contacts(Particles const& particles, Walls const& walls, WallContacts& contacts);

/// What touches a wall becomes a bond, where its pair of materials bonds at the start.
void form_wall_bonds(Particles const& particles, Walls const& walls, WallContacts const& contacts, PairTable const& pairs);

inline WallForceRows force_rows(WallContacts const& contacts) { return {contacts.begin, contacts.contact, contacts.force}; }

/// What the contacts remember, as flat named arrays (rows in the list's order; ids and flags exact as doubles), and back:
/// restored contacts carry nothing but memory and the poses that the list was built for until complete_wall_contacts or
/// search_wall_contacts places them.
std::map<std::string, std::vector<Real>> save_wall_contacts(WallContacts const& contacts);
WallContacts restore_wall_contacts(std::map<std::string, std::vector<Real>> const& arrays);

/// Key of the rows' order. 8 bits of wall, 34 of id and 22 of element: search_wall_contacts checks the ranges.
KOKKOS_FUNCTION inline std::uint64_t wall_contact_key(int wall, GrainId id, int element_of_wall)
{
    return (static_cast<std::uint64_t>(wall) << 56) | (static_cast<std::uint64_t>(id) << 22) |
           static_cast<std::uint64_t>(element_of_wall);
}

} // namespace arenite
