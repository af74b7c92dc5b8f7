// SPDX-License-Identifier: MIT
#include "kernels/wall_contacts.hpp"

#include "core/error.hpp"
#include "core/to_device.hpp"
#include "core/work_array.hpp"

#include <Kokkos_Sort.hpp>

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace arenite {
namespace {

/// Calls visit(element) for every element with a gap below skin to grain i, walls in order.
struct WallFinder {
    RecordView position;
    WallViews walls;
    int wall_count;
    Real skin;

    template <class Visit> KOKKOS_FUNCTION void operator()(int i, Visit const& visit) const
    {
        Vec3 const x = vector_of(position, i);
        Real const radius = position(i, 3), reach = radius + skin;
        for (int w = 0; w < wall_count; ++w) {
            WallBody const& body = walls.body(w);
            if (!body.present) continue;
            if (body.shape == WallShape::mesh) {
                int const shift = body.first_element - body.first_triangle;
                visit_near_triangles(walls.mesh, body.grid, body.pose.to_local(x), reach,
                                     [&](int triangle) { visit(triangle + shift); });
                continue;
            }
            for (int e = body.first_element; e < body.first_element + body.elements; ++e) {
                Real side = 0; // on whichever side: the memory of the side is found later
                if (wall_proximity(walls, body, e, x, radius, side).distance < reach) visit(e);
            }
        }
    }
};

int count_rows(WallFinder const& find, int grains, View1<int> const& begin)
{
    Kokkos::parallel_for(
        "count_wall_contacts", RangePolicy(0, grains), KOKKOS_LAMBDA(int i) {
            int count = 0;
            find(i, [&](int) { ++count; });
            begin(i) = count;
        });
    int total = 0;
    Kokkos::parallel_scan(
        "scan_wall_contacts", RangePolicy(0, grains + 1),
        KOKKOS_LAMBDA(int i, int& sum, bool last) {
            int const count = i < grains ? begin(i) : 0;
            if (last) begin(i) = sum;
            sum += count;
        },
        total);
    return total;
}

/// Rows by grain and, in a grain, by element.
void fill_rows(WallFinder const& find, int grains, WallContacts const& contacts)
{
    WallContactRows const list = contacts;
    Kokkos::parallel_for(
        "fill_wall_contacts", RangePolicy(0, grains), KOKKOS_LAMBDA(int i) {
            int const first = list.begin(i);
            if (list.begin(i + 1) == first) return; // most grains are far from all walls
            int filled = first;
            find(i, [&](int element) {
                int slot = filled++;
                while (slot > first && list.element(slot - 1) > element) {
                    list.element(slot) = list.element(slot - 1);
                    --slot;
                }
                list.element(slot) = element;
            });
            for (int c = first; c < filled; ++c) list.grain(c) = i;
        });
}

/// Puts the rows into the order of their keys; contact becomes the incidence of the grains.
void sort_rows(Particles const& particles, Walls const& walls, WallContacts& contacts)
{
    int const count = contacts.count;
    View1<std::uint64_t> const key(uninitialized("wall_contact_key"), count);
    View1<int> const order(uninitialized("wall_contact_order"), count);
    View1<int> const grain = contacts.grain, element = contacts.element, wall_of = walls.views.wall_of_element;
    View1<WallBody> const body = walls.views.body;
    View1<GrainId> const id = particles.id;
    Kokkos::parallel_for(
        "make_wall_contact_keys", RangePolicy(0, count), KOKKOS_LAMBDA(int c) {
            int const wall = wall_of(element(c));
            key(c) = wall_contact_key(wall, id(grain(c)), element(c) - body(wall).first_element);
            order(c) = c;
        });
    Kokkos::Experimental::sort_by_key(ExecutionSpace(), key, order);
    View1<int> const sorted_grain(uninitialized("wall_contact_grain"), count);
    View1<int> const sorted_element(uninitialized("wall_contact_element"), count);
    WallContactRows const list = contacts;
    Kokkos::parallel_for(
        "sort_wall_contacts", RangePolicy(0, count), KOKKOS_LAMBDA(int c) {
            int const from = order(c);
            sorted_grain(c) = grain(from);
            sorted_element(c) = element(from);
            list.id(c) = id(grain(from));
            list.contact(from) = c;
        });
    contacts.grain = sorted_grain;
    contacts.element = sorted_element;
}

void allocate_rows(WallContacts& contacts)
{
    int const n = contacts.count;
    contacts.grain = View1<int>(uninitialized("wall_contact_grain"), n);
    contacts.element = View1<int>(uninitialized("wall_contact_element"), n);
    contacts.id = View1<GrainId>(uninitialized("wall_contact_id"), n);
    contacts.contact = View1<int>(uninitialized("wall_contact_of_grain"), n);
    contacts.touching = View1<std::uint8_t>("wall_contact_touching", n);
    if (contacts.needs.bonds) contacts.adhering = View1<std::uint8_t>("wall_contact_adhering", n);
    contacts.normal = RecordView("wall_contact_normal", n);
    if (contacts.needs.history) contacts.spring = RecordView("wall_contact_spring", n);
    contacts.force = ForceRows("wall_contact_force", n);
}

/// Finds each row among the old ones by its key: the old rows are sorted by it.
void carry_rows(WallContactRows const& old, Walls const& walls, WallContacts const& contacts)
{
    WallContactRows const list = contacts;
    View1<int> const wall_of = walls.views.wall_of_element;
    View1<WallBody> const body = walls.views.body;
    bool const history = list.needs.history && old.needs.history, bonds = list.needs.bonds && old.needs.bonds;
    int const old_count = old.count;
    Kokkos::parallel_for(
        "carry_wall_contacts", RangePolicy(0, contacts.count), KOKKOS_LAMBDA(int c) {
            auto const key_of = [&](GrainId id, int element) {
                int const wall = wall_of(element);
                return wall_contact_key(wall, id, element - body(wall).first_element);
            };
            std::uint64_t const key = key_of(list.id(c), list.element(c));
            int low = 0, high = old_count;
            while (low < high) {
                int const middle = (low + high) / 2;
                if (key_of(old.id(middle), old.element(middle)) < key) low = middle + 1;
                else high = middle;
            }
            if (low == old_count || old.id(low) != list.id(c) || old.element(low) != list.element(c)) return;
            list.touching(c) = old.touching(low);
            if (bonds) list.adhering(c) = old.adhering(low);
            for (int n = 0; n < 4; ++n) {
                list.normal(c, n) = old.normal(low, n);
                if (history) list.spring(c, n) = old.spring(low, n);
            }
            for (int n = 0; n < 8; ++n) list.force(c, n) = old.force(low, n);
        });
}

void check_key_ranges(Particles const& particles, Walls const& walls)
{
    ARENITE_REQUIRE(walls.count() <= 256, "a scene has at most 256 walls");
    for (WallBody const& body : walls.body)
        ARENITE_REQUIRE(body.elements <= most_mesh_triangles, "append_mesh lets no larger mesh pass");
    GrainId largest = 0;
    View1<GrainId> const id = particles.id;
    Kokkos::parallel_reduce(
        "largest_id", RangePolicy(0, particles.count),
        KOKKOS_LAMBDA(int i, GrainId& most) { most = id(i) > most ? id(i) : most; }, Kokkos::Max<GrainId>(largest));
    ARENITE_REQUIRE(largest <= largest_grain_id, "who makes grains lets no larger id pass");
}

/// Rows where floor(id / 2^shift) or the wall changes, and the row count at the end: [boundaries + 1].
View1<int> find_boundaries(Walls const& walls, WallContacts const& contacts, int shift, int& boundaries)
{
    View1<int> const row(uninitialized("wall_contact_boundaries"), contacts.count + 1);
    View1<int> const element = contacts.element, wall_of = walls.views.wall_of_element;
    View1<GrainId> const id = contacts.id;
    int const count = contacts.count;
    Kokkos::parallel_scan(
        "wall_contact_boundaries", RangePolicy(0, count + 1),
        KOKKOS_LAMBDA(int c, int& sum, bool last) {
            bool const starts = c == 0 || c == count || wall_of(element(c)) != wall_of(element(c - 1)) ||
                                (id(c) >> shift) != (id(c - 1) >> shift);
            if (last && starts) row(sum) = c;
            sum += starts ? 1 : 0;
        },
        boundaries);
    boundaries = count == 0 ? 0 : boundaries - 1;
    return row;
}

void find_blocks(Walls const& walls, WallContacts& contacts)
{
    contacts.group = find_boundaries(walls, contacts, 0, contacts.groups);
    contacts.block = find_boundaries(walls, contacts, 6, contacts.blocks);
    contacts.superblock = find_boundaries(walls, contacts, 12, contacts.superblocks);
    View1<int> const wall(uninitialized("wall_of_superblock"), contacts.superblocks);
    View1<int> const element = contacts.element, wall_of = walls.views.wall_of_element, first = contacts.superblock;
    Kokkos::parallel_for(
        "wall_of_superblock", RangePolicy(0, contacts.superblocks),
        KOKKOS_LAMBDA(int s) { wall(s) = wall_of(element(first(s))); });
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), wall);
    contacts.wall_of_superblock.assign(host.data(), host.data() + contacts.superblocks);
    fit(contacts.block_sum, "wall_block_sum", contacts.blocks);
    fit(contacts.superblock_sum, "wall_superblock_sum", contacts.superblocks);
}

} // namespace

void search_wall_contacts(Particles const& particles, Walls const& walls, Real skin, ContactNeeds needs,
                          WallContacts& contacts)
{
    Phase const phase("wall search");
    WallContacts const old = contacts;
    contacts = WallContacts{};
    contacts.needs = needs;
    contacts.block_sum = old.block_sum;
    contacts.superblock_sum = old.superblock_sum;
    contacts.begin = View1<int>("wall_contact_begin", particles.count + 1);
    for (WallState const& state : walls.state) contacts.reference_pose.push_back(pose_of(state));
    if (walls.count() > 0 && particles.count > 0) {
        check_key_ranges(particles, walls);
        WallFinder const find{particles.position, walls.views, walls.count(), skin};
        contacts.count = count_rows(find, particles.count, contacts.begin);
        allocate_rows(contacts);
        fill_rows(find, particles.count, contacts);
        sort_rows(particles, walls, contacts);
        if (old.count > 0) carry_rows(old, walls, contacts);
    } else allocate_rows(contacts);
    find_blocks(walls, contacts);
}

void complete_wall_contacts(Particles const& particles, Walls const& walls, WallContacts& contacts)
{
    auto const ids = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.id);
    std::unordered_map<GrainId, int> row_of;
    for (int i = 0; i < particles.count; ++i) row_of[ids(i)] = i;
    auto const id = Kokkos::create_mirror_view_and_copy(HostSpace(), contacts.id);
    auto const element = Kokkos::create_mirror_view_and_copy(HostSpace(), contacts.element);
    std::vector<int> grain, order(contacts.count), begin(particles.count + 1, 0);
    for (int c = 0; c < contacts.count; ++c) {
        auto const found = row_of.find(id(c));
        if (found == row_of.end()) throw InputError("checkpoint: a wall contact of a grain that is not there");
        grain.push_back(found->second);
        ++begin[found->second + 1];
        order[c] = c;
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return std::pair(grain[a], element(a)) < std::pair(grain[b], element(b)); });
    contacts.grain = to_device(grain, "wall_contact_grain");
    contacts.begin = to_device(begin, "wall_contact_begin");
    contacts.contact = to_device(order, "wall_contact_of_grain");
    find_blocks(walls, contacts);
}

void form_wall_bonds(Particles const& particles, Walls const& walls, WallContacts const& contacts, PairTable const& pairs)
{
    ARENITE_REQUIRE(contacts.needs.bonds, "the list of wall contacts holds no bonds");
    WallContactRows const list = contacts;
    WallViews const views = walls.views;
    RecordView const position = particles.position;
    View1<std::uint8_t> const material = particles.material;
    Kokkos::parallel_for(
        "form_wall_bonds", RangePolicy(0, contacts.count), KOKKOS_LAMBDA(int c) {
            int const i = list.grain(c), element = list.element(c);
            WallBody const& body = views.body(views.wall_of_element(element));
            if (!pairs(material(i), body.material).bonds_at_start) return;
            Real side = list.normal(c, 3);
            WallProximity const p = wall_proximity(views, body, element, vector_of(position, i), position(i, 3), side);
            if (p.faces && p.distance <= position(i, 3)) list.adhering(c) = 1;
        });
}

} // namespace arenite
