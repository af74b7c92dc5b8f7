// SPDX-License-Identifier: MIT
#include "kernels/find_pairs.hpp"

#include "core/cell_list.hpp"
#include "core/error.hpp"
#include "core/lanes.hpp"
#include "kernels/contact_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
    return rows_of(list.item, 0, list.entries);
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

/// Grains of a tile of the list, or 0.
int tile_of(SearchSettings const& settings, int grains)
{
    if (!on_host || settings.whole_steps) return 0;
    if (settings.tile_grains > 0) return settings.tile_grains;
    return grains < least_tiled_grains ? 0 : default_tile_grains;
}

} // namespace

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
    Kokkos::deep_copy(contacts.reference_position, rows_of(particles.position, 0, grains));
}

} // namespace arenite
