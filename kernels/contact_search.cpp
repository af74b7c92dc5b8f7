// SPDX-License-Identifier: MIT
#include "kernels/contact_search.hpp"

#include "core/cell_list.hpp"
#include "core/error.hpp"
#include "core/lanes.hpp"
#include "core/work_array.hpp"
#include "kernels/contact_passes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arenite {
namespace {

/// Extent of the grains and of their sizes.
struct Bounds {
    Vec3 lower, upper;
    Real smallest = 0, largest = 0; // radii
};

/// Points that the search sees: the grains, then the images of those near a periodic face.
struct SearchPoints {
    int count = 0;
    RecordView position;       // [point](x, y, z, radius)
    View1<GrainId> id;         // [point]
    View1<int> row;            // [point] grain
    View1<std::uint8_t> image; // [point]
};

/// A coordinate in units of cells, brought into the grid, and its cell: what lies outside counts to the cell at that end.
/// Compared before the cast: no int holds the number of a cell that is very far away.
KOKKOS_INLINE_FUNCTION Real in_grid(Real x, int cells) { return x < 0 ? 0 : (x > cells ? Real(cells) : x); }
KOKKOS_INLINE_FUNCTION int cell_number(Real x, int cells)
{
    return x < 1 ? 0 : (x >= cells ? cells - 1 : static_cast<int>(x));
}

/// A cell grid per size level; level l holds the radii in (edge[l-1], edge[l]].
struct LevelGrids {
    static constexpr int most = 10; // a size ratio of 2^10
    int levels = 1;
    Real edge[most] = {};
    Vec3 lower[most];
    Real cells_per_length[most] = {};
    int cells[most][3] = {};
    CellList list[most];

    KOKKOS_FUNCTION int level_of(Real radius) const
    {
        int level = 0;
        while (level < levels - 1 && radius > edge[level]) ++level;
        return level;
    }
    /// In units of cells.
    KOKKOS_FUNCTION Vec3 place(int level, Vec3 const& x) const { return cells_per_length[level] * (x - lower[level]); }
    KOKKOS_FUNCTION int cell_of(int level, Vec3 const& x) const
    {
        Vec3 const at = place(level, x);
        int const* const n = cells[level];
        return cell_number(at.x, n[0]) + n[0] * (cell_number(at.y, n[1]) + n[1] * cell_number(at.z, n[2]));
    }
};

Bounds find_bounds(RecordView const& position, int count)
{
    Bounds bounds;
    Vec3 &lower = bounds.lower, &upper = bounds.upper;
    using Least = Kokkos::Min<Real>;
    using Most = Kokkos::Max<Real>;
    Kokkos::parallel_reduce(
        "find_bounds", RangePolicy(0, count),
        KOKKOS_LAMBDA(int i, Real& x0, Real& x1, Real& y0, Real& y1, Real& z0, Real& z1, Real& r0, Real& r1) {
            Real* const least[4] = {&x0, &y0, &z0, &r0};
            Real* const most[4] = {&x1, &y1, &z1, &r1};
            for (int n = 0; n < 4; ++n) {
                *least[n] = Kokkos::min(*least[n], position(i, n));
                *most[n] = Kokkos::max(*most[n], position(i, n));
            }
        },
        Least(lower.x), Most(upper.x), Least(lower.y), Most(upper.y), Least(lower.z), Most(upper.z), Least(bounds.smallest),
        Most(bounds.largest));
    return bounds;
}

/// The part of the bounds that cells are made for: a grain that flew off by more than the box is long, and leaves the run
/// when departures are looked for, must not put all others into one cell. It counts to the cell at that end.
Bounds near_box(Bounds bounds, PeriodicBox const& box)
{
    Vec3 const size = box.size();
    for (int axis = 0; axis < 3; ++axis) {
        Real const lower = std::fmax(bounds.lower[axis], box.lower[axis] - size[axis]);
        Real const upper = std::fmin(bounds.upper[axis], box.upper[axis] + size[axis]);
        if (!(size[axis] > 0) || lower > upper) continue; // no box, or nothing near it
        bounds.lower[axis] = lower;
        bounds.upper[axis] = upper;
    }
    return bounds;
}

void check_periodic_edges(PeriodicBox const& box, Real cutoff)
{
    Vec3 const size = box.size();
    for (int axis = 0; axis < 3; ++axis)
        if (box.periodic[axis] && size[axis] < 2 * cutoff)
            throw InputError(fmt::format("domain: the periodic edge along {} is {:.4g} m, shorter than two contact "
                                         "cutoffs ({:.4g} m): a pair of grains would meet across both faces",
                                         "xyz"[axis], size[axis], 2 * cutoff));
}

/// A grain that is nowhere would be left out of every list, or make a grid without end.
void check_positions(Particles const& particles)
{
    RecordView const position = particles.position;
    View1<GrainId> const id = particles.id;
    constexpr GrainId none = Kokkos::reduction_identity<GrainId>::min();
    GrainId lost = none;
    Kokkos::parallel_reduce(
        "check_positions", RangePolicy(0, particles.count),
        KOKKOS_LAMBDA(int i, GrainId& least) {
            Vec3 const x = vector_of(position, i);
            bool const somewhere = dot(x, x) < Real(1e300);
            if (!somewhere && id(i) < least) least = id(i);
        },
        Kokkos::Min<GrainId>(lost));
    if (lost != none) throw SimulationError(fmt::format("grain {}: its position is not a finite number", lost));
}

void wrap_positions(Particles const& particles, PeriodicBox const& box)
{
    RecordView const position = particles.position;
    Kokkos::parallel_for(
        "wrap_positions", RangePolicy(0, particles.count), KOKKOS_LAMBDA(int i) {
            Vec3 const size = box.size();
            for (int axis = 0; axis < 3; ++axis) {
                if (!box.periodic[axis]) continue;
                position(i, axis) -= Kokkos::floor((position(i, axis) - box.lower[axis]) / size[axis]) * size[axis];
                if (position(i, axis) >= box.upper[axis]) position(i, axis) -= size[axis]; // a rounding below lower
            }
        });
}

// ---------------------------------------------------------------- locality

KOKKOS_FUNCTION int spread_bits(int v) // 10 bits to every third place
{
    v = (v | (v << 16)) & 0x030000FF;
    v = (v | (v << 8)) & 0x0300F00F;
    v = (v | (v << 4)) & 0x030C30C3;
    return (v | (v << 2)) & 0x09249249;
}

/// Rows in Morton order of coarse cells, in a cell by id: neighbours in space are neighbours in memory.
/// Grains that do not stay are left out.
View1<int> locality_order(Particles const& particles, Bounds const& bounds, View1<int> const& keep)
{
    constexpr int bits = 6; // 64 cells along the longest edge: 262144 bins, a few grains each at a million
    Vec3 const extent = bounds.upper - bounds.lower;
    Real const longest = std::fmax(extent.x, std::fmax(extent.y, extent.z));
    Real const cell = std::fmax(longest / (1 << bits) * (1 + Real(1e-9)), 2 * bounds.largest);
    int along = 1;
    while (along < (1 << bits) && along * cell < longest) along *= 2;
    View1<int> key(uninitialized("locality_key"), particles.count);
    RecordView const position = particles.position;
    Vec3 const lower = bounds.lower;
    bool const all_stay = !keep.is_allocated();
    Kokkos::parallel_for(
        "locality_key", RangePolicy(0, particles.count), KOKKOS_LAMBDA(int i) {
            int code = 0;
            for (int axis = 0; axis < 3; ++axis)
                code |= spread_bits(cell_number((position(i, axis) - lower[axis]) / cell, along)) << axis;
            key(i) = all_stay || keep(i) ? code : -1;
        });
    CellList const list = make_cell_list(key, particles.id, particles.count, along * along * along);
    return Kokkos::subview(list.item, Kokkos::make_pair(0, list.entries));
}

// ---------------------------------------------------------------- points and grids

/// Step of the image that a position near a periodic face has on this axis: +1 near the lower face, -1 near
/// the upper one, 0 in between.
KOKKOS_FUNCTION int image_step_near(PeriodicBox const& box, int axis, Real x, Real reach)
{
    if (!box.periodic[axis]) return 0;
    if (x - box.lower[axis] < reach) return 1;
    if (box.upper[axis] - x < reach) return -1;
    return 0;
}

SearchPoints make_points(Particles const& particles, PeriodicBox const& box, Real reach)
{
    int const count = particles.count;
    SearchPoints points;
    if (!box.any_periodic()) {
        points.count = count;
        points.position = particles.position;
        points.id = particles.id;
        return points; // row and image stay empty: a point is its grain
    }
    RecordView const position = particles.position;
    View1<int> offset("image_offset", count + 1);
    Kokkos::parallel_scan(
        "count_images", RangePolicy(0, count + 1),
        KOKKOS_LAMBDA(int i, int& sum, bool last) {
            if (last) offset(i) = sum;
            if (i == count) return;
            int images = 1;
            for (int axis = 0; axis < 3; ++axis)
                if (image_step_near(box, axis, position(i, axis), reach) != 0) images *= 2;
            sum += images - 1;
        },
        points.count);
    points.count += count;
    points.position = RecordView(uninitialized("point_position"), points.count);
    points.id = View1<GrainId>(uninitialized("point_id"), points.count);
    points.row = View1<int>(uninitialized("point_row"), points.count);
    points.image = View1<std::uint8_t>(uninitialized("point_image"), points.count);
    SearchPoints const target = points;
    View1<GrainId> const id = particles.id;
    Kokkos::parallel_for(
        "make_images", RangePolicy(0, count), KOKKOS_LAMBDA(int i) {
            int step[3];
            for (int axis = 0; axis < 3; ++axis) step[axis] = image_step_near(box, axis, position(i, axis), reach);
            int slot = count + offset(i);
            for (int subset = 0; subset < 8; ++subset) {
                bool possible = true;
                int s[3];
                for (int axis = 0; axis < 3; ++axis) {
                    bool const taken = subset >> axis & 1;
                    if (taken && step[axis] == 0) possible = false;
                    s[axis] = taken ? step[axis] : 0;
                }
                if (!possible) continue;
                int const point = subset == 0 ? i : slot++;
                int const code = PeriodicBox::image_code(s[0], s[1], s[2]);
                Vec3 const shift = box.image_shift(code);
                for (int axis = 0; axis < 3; ++axis) target.position(point, axis) = position(i, axis) + shift[axis];
                target.position(point, 3) = position(i, 3);
                target.id(point) = id(i);
                target.row(point) = i;
                target.image(point) = static_cast<std::uint8_t>(code);
            }
        });
    return points;
}

LevelGrids make_grids(SearchPoints const& points, Bounds const& bounds, Real skin)
{
    LevelGrids grids;
    // Levels by factors of two in size; sizes within a factor 1.5 of each other share one.
    while (grids.levels < LevelGrids::most && bounds.largest > Real(1.5) * bounds.smallest * (1 << (grids.levels - 1)))
        ++grids.levels;
    Vec3 const reach{bounds.largest * 2 + skin, bounds.largest * 2 + skin, bounds.largest * 2 + skin};
    for (int level = 0; level < grids.levels; ++level) {
        grids.edge[level] =
            level == grids.levels - 1 ? bounds.largest : bounds.largest / static_cast<Real>(1 << (grids.levels - 1 - level));
        grids.lower[level] = bounds.lower - reach;
        Vec3 const extent = bounds.upper - bounds.lower + 2 * reach;
        Real cell = 2 * grids.edge[level] + skin;
        // A grain far away must not make a grid that does not fit: at most eight cells a point.
        auto const total = [&](Real c) {
            return std::ceil(extent.x / c) * std::ceil(extent.y / c) * std::ceil(extent.z / c);
        };
        while (total(cell) > Real(8) * points.count + 4096) cell *= Real(1.25);
        grids.cells_per_length[level] = 1 / cell;
        for (int axis = 0; axis < 3; ++axis) grids.cells[level][axis] = static_cast<int>(std::ceil(extent[axis] / cell));
    }
    for (int level = 0; level < grids.levels; ++level) {
        View1<int> cell_of_point(uninitialized("cell_of_point"), points.count);
        RecordView const position = points.position;
        LevelGrids const shape = grids;
        Kokkos::parallel_for(
            "cell_of_point", RangePolicy(0, points.count), KOKKOS_LAMBDA(int p) {
                cell_of_point(p) =
                    shape.level_of(position(p, 3)) == level ? shape.cell_of(level, vector_of(position, p)) : -1;
            });
        int const cells = grids.cells[level][0] * grids.cells[level][1] * grids.cells[level][2];
        grids.list[level] = make_cell_list(cell_of_point, points.id, points.count, cells);
    }
    return grids;
}

// ---------------------------------------------------------------- pairs

/// Calls visit(point, section) for every point that makes a pair with grain i as its first; section: a Section.
struct PairFinder {
    RecordView position;
    View1<GrainId> id;
    SearchPoints points;
    LevelGrids grids;
    Real skin;
    int tile_grains;

    KOKKOS_FUNCTION int section_of(int i, int point, bool close) const
    {
        if (tile_grains == 0) return close ? Section::close : Section::others;
        int const partner = points.row.extent(0) > 0 ? points.row(point) : point, tile = i / tile_grains,
                  other_tile = partner / tile_grains;
        if (!close) return tile <= other_tile ? Section::others_up : Section::others_down;
        return tile == other_tile ? Section::close_within : tile < other_tile ? Section::close_up : Section::close_down;
    }

    template <class Visit> KOKKOS_FUNCTION void operator()(int i, Visit const& visit) const
    {
        Vec3 const x = vector_of(position, i);
        Real const radius = position(i, 3);
        int const own = grids.level_of(radius);
        for (int level = own; level < grids.levels; ++level) {
            CellList const& list = grids.list[level];
            int const* const cells = grids.cells[level];
            Vec3 const at = grids.place(level, x);
            Real const y = in_grid(at.y, cells[1]), z = in_grid(at.z, cells[2]);
            Real const reach = (radius + grids.edge[level] + skin) * grids.cells_per_length[level] *
                               (1 + Real(1e-9)); // more than roundings of cells' faces
            int const low_z = cell_number(z - reach, cells[2]), high_z = cell_number(z + reach, cells[2]);
            int const low_y = cell_number(y - reach, cells[1]), high_y = cell_number(y + reach, cells[1]);
            auto const gap = [](int layer, Real place) { return larger(larger(layer - place, place - (layer + 1)), 0); };
            for (int cz = low_z; cz <= high_z; ++cz) {
                Real const gap_z = gap(cz, z);
                for (int cy = low_y; cy <= high_y; ++cy) {
                    Real const gap_y = gap(cy, y), left = reach * reach - gap_y * gap_y - gap_z * gap_z;
                    if (left < 0) continue;
                    Real const along_x = Kokkos::sqrt(left);
                    // The cells of a row follow each other, and so do their entries.
                    int const row = cells[0] * (cy + cells[1] * cz);
                    int const end = list.begin(row + cell_number(at.x + along_x, cells[0]) + 1);
                    for (int k = list.begin(row + cell_number(at.x - along_x, cells[0])); k < end; ++k) {
                        // Near first: hardly a point is, and that of two is first which is not easily guessed.
                        int const point = list.item(k);
                        Quad const there = load_record(&points.position(point, 0));
                        Vec3 const d{x.x - there[0], x.y - there[1], x.z - there[2]};
                        Real const square = dot(d, d), other = there[3], cutoff = radius + other + skin;
                        if (square >= cutoff * cutoff) continue;
                        if (other < radius || (other == radius && points.id(point) <= id(i))) continue;
                        Real const near = radius + other + close_share * skin;
                        visit(point, section_of(i, point, square < near * near));
                    }
                }
            }
        }
    }
};

/// The first points that make a pair with a grain, Section::most * point + section: most grains have no more, and need not
/// be searched for a second time.
using FoundPoints = Kokkos::View<int* [8], Kokkos::LayoutRight, MemorySpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

/// In memory that is needed for the records only later.
FoundPoints found_points_in(RecordView const& records)
{
    static_assert(sizeof(int) * FoundPoints::static_extent(1) <= sizeof(Real) * RecordView::static_extent(1));
    return FoundPoints(reinterpret_cast<int*>(records.data()), records.extent(0));
}

/// Returns how many pairs there are, and where those of each row begin.
int count_pairs(PairFinder const& find, ContactList const& contacts, FoundPoints const& found)
{
    int const grains = contacts.grains(), sections = contacts.sections();
    View1<int> const row_begin = contacts.row_begin;
    Kokkos::parallel_for(
        "count_pairs", Kokkos::RangePolicy<ExecutionSpace, Kokkos::Schedule<Kokkos::Dynamic>>(0, grains),
        KOKKOS_LAMBDA(int i) {
            int all = 0, count[Section::most] = {};
            find(i, [&](int point, int section) {
                if (all < found.extent_int(1)) found(i, all) = Section::most * point + section;
                ++all;
                ++count[section];
            });
            for (int section = 0; section < sections; ++section) row_begin(section * grains + i) = count[section];
        });
    std::int64_t total = 0;
    Kokkos::parallel_scan(
        "scan_pairs", RangePolicy(0, sections * grains + 1),
        KOKKOS_LAMBDA(int row, std::int64_t& sum, bool last) {
            int const count = row < sections * grains ? row_begin(row) : 0;
            if (last) row_begin(row) = static_cast<int>(sum);
            sum += count;
        },
        total);
    constexpr std::int64_t most = (1 << 30) - 64; // twice a contact's number is an int
    if (total > most) throw InputError(fmt::format("{} contacts are more than the {} that a run can have", total, most));
    return static_cast<int>(total);
}

/// Contacts that were close when the list was built.
int count_close(ContactList const& list)
{
    int close = 0;
    Kokkos::deep_copy(close, Kokkos::subview(list.row_begin, list.close_sections() * list.grains()));
    return close;
}

void fill_pairs(PairFinder const& find, FoundPoints const& found, ContactList const& contacts,
                View1<int> const& point_of_contact)
{
    int const grains = contacts.grains();
    ContactList const list = contacts;
    View1<int> const row = find.points.row;
    View1<std::uint8_t> const image = find.points.image;
    View1<GrainId> const id = find.points.id;
    Kokkos::parallel_for(
        "fill_pairs", Kokkos::RangePolicy<ExecutionSpace, Kokkos::Schedule<Kokkos::Dynamic>>(0, grains),
        KOKKOS_LAMBDA(int i) {
            int first[Section::most], filled[Section::most], pairs = 0;
            for (int section = 0; section < list.sections(); ++section) {
                int const row = section * grains + i;
                first[section] = filled[section] = list.row_begin(row);
                pairs += list.row_begin(row + 1) - list.row_begin(row);
            }
            auto const put = [&](int point, int section) { // insertion by partner id keeps the row sorted
                int slot = filled[section]++;
                while (slot > first[section] && id(point_of_contact(slot - 1)) > id(point)) {
                    point_of_contact(slot) = point_of_contact(slot - 1);
                    --slot;
                }
                point_of_contact(slot) = point;
            };
            if (pairs > found.extent_int(1)) find(i, put);
            else
                for (int n = 0; n < pairs; ++n) put(found(i, n) / Section::most, found(i, n) % Section::most);
            for_each_owned(list, i, [&](int c) {
                int const point = point_of_contact(c);
                list.first(c) = i;
                list.second(c) = list.periodic ? row(point) : point;
                if (list.periodic) list.image(c) = image(point);
            });
        });
}

template <class View> auto rows_of(View const& view, int begin, int end)
{
    if constexpr (View::rank == 1) return Kokkos::subview(view, Kokkos::make_pair(begin, end));
    else return Kokkos::subview(view, Kokkos::make_pair(begin, end), Kokkos::ALL);
}

/// An array of `length` rows. Those of contacts are what it had, else still to be written; those behind them are.
template <class View> void fit_contacts(ContactList const& contacts, View& view, char const* label, int length, int behind)
{
    View const before = view;
    view = View(uninitialized(label), length);
    Kokkos::deep_copy(rows_of(view, contacts.count, length), behind);
    if (before.is_allocated() && contacts.count > 0)
        Kokkos::deep_copy(rows_of(view, 0, contacts.count), rows_of(before, 0, contacts.count));
}

/// Rows of an array with one per contact.
int padded_count(ContactList const& contacts)
{
    return (contacts.count + contact_block - 1) / contact_block * contact_block;
}

/// The two grains of each contact and what it remembers but its force.
void fit_memory(ContactList& contacts)
{
    int const n = padded_count(contacts);
    fit_contacts(contacts, contacts.first, "contact_first", n, 0);
    fit_contacts(contacts, contacts.second, "contact_second", n + second_ahead, 0);
    if (contacts.periodic) fit_contacts(contacts, contacts.image, "contact_image", n, PeriodicBox::image_code(0, 0, 0));
    fit_contacts(contacts, contacts.touching, "contact_touching", n, 0);
    if (contacts.needs.bonds) fit_contacts(contacts, contacts.adhering, "contact_adhering", n, 0);
    if (contacts.needs.history) fit_contacts(contacts, contacts.spring, "contact_spring", n, 0);
    if (contacts.needs.contact_radius) fit_contacts(contacts, contacts.contact_radius, "contact_radius", n, 0);
}

/// Contacts' force rows and those that passes share.
int force_row_count(ContactList const& contacts)
{
    return padded_count(contacts) + shared_rows(contacts, ExecutionSpace().concurrency());
}

void set_scales(Particles const& particles, ContactList& contacts)
{
    int const n = padded_count(contacts);
    fit_contacts(contacts, contacts.scale, "contact_scale", n, 1);
    if (contacts.needs.bonds) fit_contacts(contacts, contacts.inverse_cube_root, "contact_inverse_cube_root", n, 1);
    ContactList const list = contacts;
    RecordView const position = particles.position, velocity = particles.velocity;
    View1<Motion> const motion = particles.motion;
    Kokkos::parallel_for(
        "set_scales", RangePolicy(0, contacts.count), KOKKOS_LAMBDA(int c) {
            int const i = list.first(c), j = list.second(c);
            Real const ri = position(i, 3), rj = position(j, 3), mi = velocity(i, 3), mj = velocity(j, 3);
            Real const radius = ri * rj / (ri + rj);
            list.scale(c, 0) = radius;
            // A grain that no force moves takes part as a wall does, with any mass: then the restitution is the free one's.
            bool const i_moves = motion(i) == Motion::free, j_moves = motion(j) == Motion::free;
            list.scale(c, 1) = i_moves == j_moves ? mi * mj / (mi + mj) : i_moves ? mi : mj;
            if (list.needs.bonds) list.inverse_cube_root(c) = 1 / Kokkos::cbrt(radius);
        });
}

/// The exact rows of each grain's contacts in the order of its partners' ids, with what the contacts remember of a force.
void make_incidence(Particles const& particles, ContactList& contacts)
{
    int const grains = particles.count;
    contacts.incident_begin = View1<int>(uninitialized("incident_begin"), 2 * grains + 1);
    contacts.incident = View1<int>("incident", 2 * contacts.count + incident_ahead);
    contacts.incident_place = View1<std::uint8_t>(uninitialized("incident_place"), 2 * (contacts.count - contacts.close));
    contacts.awake = View1<std::uint8_t>("contact_awake", grains);
    ContactList const list = contacts;
    View1<int> const left("incident_left", 2 * grains); // still to be filled in; a grain's others at grains + i
    Kokkos::parallel_for(
        "count_incident", RangePolicy(0, list.count), KOKKOS_LAMBDA(int c) {
            int const rows = c < list.close ? 0 : grains;
            Kokkos::atomic_inc(&left(rows + list.first(c)));
            Kokkos::atomic_inc(&left(rows + list.second(c)));
        });
    Kokkos::parallel_for(
        "join_incident", RangePolicy(0, grains), KOKKOS_LAMBDA(int i) {
            if (left(i) <= most_places) return;
            left(i) += left(grains + i);
            left(grains + i) = 0;
        });
    Kokkos::parallel_scan(
        "scan_incident", RangePolicy(0, 2 * grains + 1), KOKKOS_LAMBDA(int row, int& sum, bool last) {
            if (last) list.incident_begin(row) = sum;
            sum += row < 2 * grains ? left(row) : 0;
        });
    Kokkos::parallel_for(
        "fill_incident", RangePolicy(0, list.count), KOKKOS_LAMBDA(int c) {
            for (int side = 0; side < 2; ++side) {
                int const i = side ? list.second(c) : list.first(c);
                int row = c < list.close ? i : grains + i;
                if (list.incident_begin(row) == list.incident_begin(row + 1)) row = i; // joined
                list.incident(list.incident_begin(row) + Kokkos::atomic_fetch_sub(&left(row), 1) - 1) = 2 * c + side;
                if (c >= list.close && list.touching(c)) list.awake(i) = 1;
            }
        });
    View1<GrainId> const id = particles.id;
    Kokkos::parallel_for(
        "sort_incident", RangePolicy(0, grains), KOKKOS_LAMBDA(int i) {
            auto const partner = [&](int entry) { return id(entry & 1 ? list.first(entry / 2) : list.second(entry / 2)); };
            auto const sort = [&](int begin, int end) { // by insertion
                for (int k = begin + 1; k < end; ++k) {
                    int const entry = list.incident(k);
                    GrainId const key = partner(entry);
                    int slot = k;
                    for (; slot > begin && partner(list.incident(slot - 1)) > key; --slot)
                        list.incident(slot) = list.incident(slot - 1);
                    list.incident(slot) = entry;
                }
            };
            sort(list.incident_begin(i), list.incident_begin(i + 1));
            int const begin = list.incident_begin(grains + i), end = list.incident_begin(grains + i + 1);
            sort(begin, end);
            int const close_begin = list.incident_begin(i), close_end = list.incident_begin(i + 1);
            for (int k = begin, close = close_begin; k < end; ++k) {
                GrainId const key = partner(list.incident(k));
                while (close < close_end && partner(list.incident(close)) < key) ++close;
                list.incident_place(k - list.incident_begin(grains)) = static_cast<std::uint8_t>(close - close_begin);
            }
        });
}

/// What a list remembers of its contacts. The arrays of all else are free once the list itself is.
ContactList memory_of(ContactList const& list)
{
    ContactList memory;
    memory.count = list.count;
    memory.close = list.close;
    memory.tile_grains = list.tile_grains;
    memory.needs = list.needs;
    memory.row_begin = list.row_begin;
    memory.second = list.second;
    memory.touching = list.touching;
    memory.adhering = list.adhering;
    memory.spring = list.spring;
    memory.contact_radius = list.contact_radius;
    memory.force = list.force;
    return memory;
}

/// The memory of the list before, and where its contacts are: in the old row of their first grain, by their partner's id.
struct OldContacts {
    ContactList list;
    View1<GrainId> id; // [old row]
    View1<int> row;    // [grain] its row in the old list

    /// -1: a new pair.
    KOKKOS_FUNCTION int find(int grain, GrainId partner) const
    {
        int from = -1;
        for_each_owned(list, row(grain), [&](int k) {
            if (id(list.second(k)) == partner) from = k;
        });
        return from;
    }
};

/// What every contact remembers but its force; a new one begins with nothing.
void carry_memory(OldContacts const& old, Particles const& particles, ContactList const& contacts)
{
    ContactList const list = contacts;
    View1<GrainId> const id = particles.id;
    ContactNeeds const had = old.list.needs;
    Kokkos::parallel_for(
        "carry_memory", RangePolicy(0, contacts.count), KOKKOS_LAMBDA(int c) {
            int const from = old.find(list.first(c), id(list.second(c)));
            bool const known = from >= 0;
            list.touching(c) = known && old.list.touching(from) != 0;
            if (list.needs.bonds) list.adhering(c) = known && had.bonds ? old.list.adhering(from) : 0;
            if (list.needs.history)
                for (int n = 0; n < 3; ++n) list.spring(c, n) = known && had.history ? old.list.spring(from, n) : 0;
            if (list.needs.contact_radius)
                list.contact_radius(c) = known && had.contact_radius ? old.list.contact_radius(from) : 0;
        });
}

/// Rows of forces, all zero, in the memory of `spare` where that has as many; else spare's is free before theirs is taken.
void make_force_rows(ForceRows spare, ContactList& contacts)
{
    int const rows = force_row_count(contacts);
    if (spare.extent_int(0) >= rows) contacts.force = rows_of(spare, 0, rows);
    spare = {};
    if (!contacts.force.is_allocated()) contacts.force = ForceRows(uninitialized("contact_force"), rows);
    ForceRows const force = contacts.force;
    Kokkos::parallel_for(
        "clear_forces", RangePolicy(0, rows), KOKKOS_LAMBDA(int row) {
            for (int n = 0; n < 8; ++n) force(row, n) = 0;
        });
}

/// The forces of contacts that touched; what does not touch may have an older force in the old row.
void carry_forces(OldContacts const& old, Particles const& particles, ContactList const& contacts)
{
    ContactList const list = contacts;
    View1<GrainId> const id = particles.id;
    Kokkos::parallel_for(
        "carry_forces", RangePolicy(0, contacts.count), KOKKOS_LAMBDA(int c) {
            if (!list.touching(c)) return;
            int const from = old.find(list.first(c), id(list.second(c)));
            for (int n = 0; n < 8; ++n) list.force(c, n) = old.list.force(from, n);
        });
}

/// Grains of a tile of the list, or 0.
int tile_of(SearchSettings const& settings, int grains)
{
    if (!on_host || settings.whole_steps) return 0;
    if (settings.tile_grains > 0) return settings.tile_grains;
    return grains < least_tiled_grains ? 0 : default_tile_grains;
}

/// Puts the grains that stay into locality order; returns the row that each came from. spare: of as many records.
View1<int> sort_grains(Particles& particles, PeriodicBox const& box, SearchSettings const& settings, RecordView& spare)
{
    if (particles.count == 0) return View1<int>("sorted_from", 0);
    check_positions(particles);
    wrap_positions(particles, box);
    Bounds const bounds = near_box(find_bounds(particles.position, particles.count), box);
    check_periodic_edges(box, 2 * bounds.largest + settings.skin);
    View1<int> const order = locality_order(particles, bounds, settings.keep);
    permute(particles, order, spare);
    return order;
}

/// The list but for what its contacts remember.
void find_pairs(Particles const& particles, PeriodicBox const& box, SearchSettings const& settings, ContactList& contacts)
{
    Real const skin = settings.skin;
    int const grains = particles.count;
    contacts.tile_grains = tile_of(settings, grains);
    contacts.row_begin = View1<int>("contact_row_begin", contacts.sections() * grains + 1);
    if (grains == 0) return fit_memory(contacts);
    Bounds const bounds = near_box(find_bounds(particles.position, grains), box);
    PairFinder find{particles.position,  particles.id, make_points(particles, box, 2 * bounds.largest + skin), {}, skin,
                    contacts.tile_grains};
    find.grids = make_grids(find.points, bounds, skin);
    FoundPoints const found = found_points_in(contacts.reference_position);
    contacts.count = count_pairs(find, contacts, found);
    contacts.close = count_close(contacts);
    fit_memory(contacts);
    View1<int> const point_of_contact(uninitialized("point_of_contact"), contacts.count);
    fill_pairs(find, found, contacts, point_of_contact);
    Kokkos::deep_copy(contacts.reference_position,
                      Kokkos::subview(particles.position, Kokkos::make_pair(0, grains), Kokkos::ALL));
}

} // namespace

void search_contacts(Particles& particles, PeriodicBox const& box, SearchSettings const& settings, ContactList& contacts)
{
    Phase const phase("contact search");
    OldContacts old{memory_of(contacts), particles.id, {}};
    RecordView records = contacts.reference_position;
    contacts = ContactList{};
    fit(records, "reference_position", particles.count);
    old.row = sort_grains(particles, box, settings, records);
    contacts.needs = settings.needs;
    contacts.periodic = box.any_periodic();
    contacts.reference_position = records;
    find_pairs(particles, box, settings, contacts);
    carry_memory(old, particles, contacts);
    make_force_rows(settings.forces_follow ? std::exchange(old.list.force, {}) : ForceRows{}, contacts);
    if (!settings.forces_follow) carry_forces(old, particles, contacts);
    old = {};
    set_scales(particles, contacts);
    make_incidence(particles, contacts);
}

void complete_list(Particles const& particles, ContactList& contacts)
{
    contacts.close = count_close(contacts);
    // As many rows beyond the last contact as the kernels of this program want.
    fit_memory(contacts);
    fit_contacts(contacts, contacts.force, "contact_force", force_row_count(contacts), 0);
    ContactList const list = contacts;
    Kokkos::parallel_for(
        "complete_list", RangePolicy(0, particles.count),
        KOKKOS_LAMBDA(int i) { for_each_owned(list, i, [&](int c) { list.first(c) = i; }); });
    set_scales(particles, contacts);
    make_incidence(particles, contacts);
}

int form_bonds(Particles const& particles, PeriodicBox const& box, ContactList const& contacts, PairTable const& pairs)
{
    ARENITE_REQUIRE(contacts.needs.bonds, "the contact list holds no bonds");
    ContactList const list = contacts;
    RecordView const position = particles.position;
    View1<std::uint8_t> const material = particles.material;
    int bonds = 0;
    Kokkos::parallel_reduce(
        "form_bonds", RangePolicy(0, contacts.count),
        KOKKOS_LAMBDA(int c, int& sum) {
            int const i = list.first(c), j = list.second(c);
            if (pairs(material(i), material(j)).bonds_at_start &&
                position(i, 3) + position(j, 3) - norm(contact_offset(list, position, box, c)) >= 0)
                list.adhering(c) = 1;
            sum += list.adhering(c);
        },
        bonds);
    return bonds;
}

void count_bonds(Particles const& particles, ContactList const& contacts, View1<int> const& bonds,
                 View1<int> const& coordination)
{
    ContactList const list = contacts;
    Kokkos::parallel_for(
        "count_bonds", RangePolicy(0, particles.count), KOKKOS_LAMBDA(int i) {
            int bonded = 0, touching = 0;
            for (int row = i; row < 2 * list.grains(); row += list.grains())
                for (int k = list.incident_begin(row); k < list.incident_begin(row + 1); ++k) {
                    int const c = list.incident(k) / 2;
                    touching += list.touching(c) ? 1 : 0;
                    if (list.needs.bonds) bonded += list.adhering(c) ? 1 : 0;
                }
            bonds(i) = bonded;
            coordination(i) = touching;
        });
}

} // namespace arenite
