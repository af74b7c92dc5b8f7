// SPDX-License-Identifier: MIT
#include "kernels/wall_reactions.hpp"

namespace arenite {
namespace {

void sum_blocks(Particles const& particles, Walls const& walls, WallContacts const& contacts)
{
    WallSums<MemorySpace> const sums = contacts.block_sum;
    WallContactRows const list = contacts;
    WallViews const views = walls.views;
    RecordView const position = particles.position, velocity = particles.velocity;
    Kokkos::parallel_for(
        "sum_wall_blocks", RangePolicy(0, contacts.blocks), KOKKOS_LAMBDA(int b) {
            Vec3 force, torque;
            Real stiffness = 0, impedance = 0;
            for (int c = list.block(b); c < list.block(b + 1); ++c) {
                if (!list.touching(c)) continue;
                Vec3 const point = views.body(views.wall_of_element(list.element(c))).pose.position;
                Vec3 const f{list.force(c, 0), list.force(c, 1), list.force(c, 2)}; // on the grain
                Vec3 const moment{list.force(c, 4), list.force(c, 5), list.force(c, 6)};
                int const i = list.grain(c);
                // (x - arm n - point) x (-f)
                torque += list.force(c, 3) * moment - cross(vector_of(position, i) - point, f);
                force -= f;
                stiffness += list.force(c, 7);
                impedance += Kokkos::sqrt(list.force(c, 7) * velocity(i, 3));
            }
            for (int n = 0; n < 3; ++n) {
                sums(b, n) = force[n];
                sums(b, 3 + n) = torque[n];
            }
            sums(b, 6) = stiffness;
            sums(b, 7) = impedance;
        });
}

/// Sums the blocks that lie in each superblock; both are given by their first rows, ascending.
void sum_superblocks(WallContacts const& contacts)
{
    WallSums<MemorySpace> const blocks = contacts.block_sum;
    WallSums<PinnedSpace> const sums = contacts.superblock_sum;
    View1<int> const block = contacts.block, superblock = contacts.superblock;
    int const block_count = contacts.blocks;
    Kokkos::parallel_for(
        "sum_wall_superblocks", RangePolicy(0, contacts.superblocks), KOKKOS_LAMBDA(int s) {
            int low = 0, high = block_count; // first block of this superblock
            while (low < high) {
                int const middle = (low + high) / 2;
                if (block(middle) < superblock(s)) low = middle + 1;
                else high = middle;
            }
            Real sum[8] = {};
            for (int b = low; b < block_count && block(b) < superblock(s + 1); ++b)
                for (int n = 0; n < 8; ++n) sum[n] += blocks(b, n);
            for (int n = 0; n < 8; ++n) sums(s, n) = sum[n];
        });
}

} // namespace

std::vector<WallReaction> measure_walls(Particles const& particles, Walls const& walls, WallContacts const& contacts)
{
    Phase const phase("wall reactions");
    std::vector<WallReaction> reactions(walls.count());
    if (contacts.count == 0) return reactions;
    sum_blocks(particles, walls, contacts);
    sum_superblocks(contacts);
    ExecutionSpace().fence("wall reactions"); // then the host sees what the device wrote
    WallSums<PinnedSpace> const& sums = contacts.superblock_sum;
    for (int s = 0; s < contacts.superblocks; ++s) {
        WallReaction& r = reactions[contacts.wall_of_superblock[s]];
        r.force += Vec3{sums(s, 0), sums(s, 1), sums(s, 2)};
        r.torque += Vec3{sums(s, 3), sums(s, 4), sums(s, 5)};
        r.stiffness += sums(s, 6);
        r.impedance += sums(s, 7);
    }
    return reactions;
}

Real largest_wall_overlap_ratio(Particles const& particles, WallContacts const& contacts)
{
    Real largest = 0;
    WallContactRows const list = contacts;
    RecordView const position = particles.position;
    Kokkos::parallel_reduce(
        "largest_wall_overlap_ratio", RangePolicy(0, contacts.count),
        KOKKOS_LAMBDA(int c, Real& most) {
            if (!list.touching(c)) return;
            Real const ratio = 1 - list.force(c, 3) / position(list.grain(c), 3);
            most = ratio > most ? ratio : most;
        },
        Kokkos::Max<Real>(largest));
    return contacts.count > 0 ? Kokkos::fmax(largest, Real(0)) : Real(0);
}

} // namespace arenite
