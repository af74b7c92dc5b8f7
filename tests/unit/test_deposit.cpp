// SPDX-License-Identifier: MIT
// The deposit's weights: they sum to one wherever a grain is, interpolation is the adjoint of the deposit,
// a uniform pack is uniform up to the walls, and the bits do not depend on the order of the rows.
#include "fluid/deposit.hpp"
#include "fluid/deposit_by_teams.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <vector>

namespace arenite {
namespace {

constexpr Real rounding = 1e-14; // a few hundred terms of order one

Grid box(int nx, int ny, int nz, bool px, bool py, bool pz)
{
    Grid grid;
    grid.cells[0] = nx, grid.cells[1] = ny, grid.cells[2] = nz;
    grid.periodic[0] = px, grid.periodic[1] = py, grid.periodic[2] = pz;
    grid.lower = {-1e-3, 2e-3, 0};
    grid.spacing = {1e-3, 1.5e-3, 0.8e-3};
    return grid;
}

Particles grains_at(std::vector<Vec3> const& where, Real diameter = 2e-4)
{
    std::vector<Grain> grains(where.size());
    for (std::size_t i = 0; i < where.size(); ++i) grains[i].position = where[i], grains[i].diameter = diameter;
    return make_particles(grains, {1000});
}

std::vector<Vec3> random_points(Grid const& grid, int count)
{
    std::mt19937_64 engine(7);
    std::uniform_real_distribution<Real> share(0, 1);
    std::vector<Vec3> points(count);
    for (auto& p : points)
        for (int axis = 0; axis < 3; ++axis) p[axis] = grid.lower[axis] + share(engine) * grid.length(axis);
    return points;
}

/// Corners, edges, faces, cell faces and centres.
std::vector<Vec3> special_points(Grid const& grid)
{
    std::vector<Vec3> points;
    for (Real const x : {0., 1e-12, 0.5, 0.25, 1 - 1e-12, 1.})
        for (Real const y : {0., 0.5, 1.})
            for (Real const z : {0., 0.125, 1.})
                points.push_back(grid.lower + Vec3{x * grid.length(0), y * grid.length(1), z * grid.length(2)});
    return points;
}

GrainWeights weights_of(Grid const& grid, Real radius, Particles const& particles)
{
    return make_grain_weights(make_deposit_stencil(grid, radius), particles.position, particles.id, particles.count);
}

TableView uniform_table(int rows, int columns, Real value)
{
    TableView table("table", rows, columns);
    Kokkos::deep_copy(table, value);
    return table;
}

/// Values that depend on the grain only, not on its row or entry.
TableView table_by_id(GrainWeights const& weights, View1<GrainId> const& id, int columns)
{
    TableView table("table", weights.entries, columns);
    Kokkos::parallel_for(
        "table_by_id", RangePolicy(0, weights.entries), KOKKOS_LAMBDA(int entry) {
            for (int q = 0; q < columns; ++q)
                table(entry, q) = Kokkos::sin(Real(1 + q) * (1 + id(weights.bins.item(entry))));
        });
    return table;
}

/// A field to interpolate, of four components.
TableView waves(Grid const& grid)
{
    TableView const field = make_interpolated("field", grid, 4);
    auto const host = Kokkos::create_mirror_view(field);
    for (int c = 0; c < grid.cell_count(); ++c)
        for (int q = 0; q < 4; ++q) host(c, q) = std::cos(0.7 * c + q);
    Kokkos::deep_copy(field, host);
    return field;
}

TableView interpolate_all(GrainWeights const& weights, TableView const& cell)
{
    TableView value("value", weights.entries, 4);
    Kokkos::parallel_for(
        "interpolate_all", RangePolicy(0, weights.entries), KOKKOS_LAMBDA(int entry) {
            Real result[4];
            interpolate_at(weights, entry, cell, result);
            for (int q = 0; q < 4; ++q) value(entry, q) = result[q];
        });
    return value;
}

TableView interpolate_groups(GrainWeights const& weights, TableView const& cell)
{
    TableView value("value", weights.entries, 4);
    Kokkos::parallel_for(
        "interpolate_groups", RangePolicy(0, weights.entry_groups()), KOKKOS_LAMBDA(int group) {
            int entry[lane_count], row[lane_count];
            weights.entries_of(group, entry, row);
            Lanes mean[4];
            interpolate_at(weights, entry, cell, mean);
            store_records({{mean[0], mean[1], mean[2]}, mean[3]}, value.data(), entry);
        });
    return value;
}

std::vector<Real> host_column(TableView const& table, int column)
{
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), table);
    std::vector<Real> values(table.extent(0));
    for (std::size_t r = 0; r < values.size(); ++r) values[r] = host(r, column);
    return values;
}

Real sum(std::vector<Real> const& values) { return std::accumulate(values.begin(), values.end(), Real(0)); }

std::vector<Real> deposited(Grid const& grid, Real radius, Particles const& particles, int columns)
{
    GrainWeights const weights = weights_of(grid, radius, particles);
    TableView const cell("cell", grid.cell_count(), columns);
    deposit(weights, table_by_id(weights, particles.id, columns), cell, columns);
    return host_column(cell, columns - 1);
}

std::vector<Grid> grids()
{
    return {box(6, 5, 4, false, false, false), box(6, 5, 4, true, true, true), box(3, 1, 8, true, false, true),
            box(1, 1, 1, false, true, false), box(2, 7, 3, true, false, false)};
}

constexpr Real radii[] = {1e-9, 1e-4, 4e-4, 1e-3, 1.5e-3, 4e-3}; // m: 1e-6 to 5 cells

} // namespace

TEST(Deposit, WeightsOfAGrainSumToOne)
{
    for (Grid const& grid : grids())
        for (Real const radius : radii) {
            std::vector<Vec3> points = special_points(grid);
            for (Vec3 const& p : random_points(grid, 20)) points.push_back(p);
            Particles const particles = grains_at(points);
            GrainWeights const weights = weights_of(grid, radius, particles);
            ASSERT_EQ(weights.entries, particles.count);
            TableView const ones = make_interpolated("ones", grid, 4);
            Kokkos::deep_copy(ones, 1);
            for (Real const one : host_column(interpolate_all(weights, ones), 0)) EXPECT_NEAR(one, 1, rounding);
            TableView const cell("cell", grid.cell_count(), 1);
            deposit(weights, uniform_table(weights.entries, 1, 1), cell, 1);
            EXPECT_NEAR(sum(host_column(cell, 0)) / particles.count, 1, rounding);
        }
}

TEST(Deposit, SmallSupportIsTheContainingCell)
{
    Grid const grid = box(6, 5, 4, false, true, false);
    Particles const particles = grains_at({grid.center(2, 3, 1)});
    GrainWeights const weights = weights_of(grid, 0.4 * grid.spacing.z, particles); // below half the shortest edge
    TableView const cell("cell", grid.cell_count(), 1);
    deposit(weights, uniform_table(1, 1, 1), cell, 1);
    EXPECT_EQ(host_column(cell, 0)[2 + 6 * (3 + 5 * 1)], 1);
}

TEST(Deposit, WeightsAreTheKernelsIntegrals)
{
    Grid const grid = box(9, 1, 1, false, false, false);
    Real const radius = 1.7e-3, x = grid.lower.x + 4.3e-3;
    Particles const particles = grains_at({Vec3{x, grid.lower.y + 1e-4, 1e-4}});
    TableView const cell("cell", 9, 1);
    deposit(weights_of(grid, radius, particles), uniform_table(1, 1, 1), cell, 1);
    std::vector<Real> const weight = host_column(cell, 0);
    constexpr int panels = 2000; // midpoint rule: error 1e-7 of a smooth kernel
    for (int i = 0; i < 9; ++i) {
        Real integral = 0;
        for (int n = 0; n < panels; ++n) {
            Real const s = (grid.lower.x + (i + (n + 0.5) / panels) * grid.spacing.x - x) / radius;
            if (std::abs(s) < 1) integral += 15. / 16 * (1 - s * s) * (1 - s * s) * grid.spacing.x / panels / radius;
        }
        EXPECT_NEAR(weight[i], integral, 1e-6);
    }
}

/// So a grain's bits do not depend on who else is in its group, nor on whether they share a block.
TEST(Deposit, AGroupsMeansAreThoseOfItsEntries)
{
    for (Grid const& grid : grids())
        for (Real const radius : radii)
            for (int const grains : {1, 61, 3000}) {
                GrainWeights const weights = weights_of(grid, radius, grains_at(random_points(grid, grains)));
                TableView const field = waves(grid), one = interpolate_all(weights, field),
                                by_group = interpolate_groups(weights, field);
                for (int q = 0; q < 4; ++q)
                    EXPECT_EQ(host_column(one, q), host_column(by_group, q)) << radius << " m, " << q;
            }
}

TEST(Deposit, InterpolationIsTheAdjoint)
{
    for (Grid const& grid : grids())
        for (Real const radius : radii) {
            Particles const particles = grains_at(random_points(grid, 300));
            GrainWeights const weights = weights_of(grid, radius, particles);
            TableView const amount = table_by_id(weights, particles.id, 4);
            TableView const field = waves(grid);
            TableView const cell("cell", grid.cell_count(), 4);
            deposit(weights, amount, cell, 4);
            TableView const value = interpolate_all(weights, field);
            for (int q = 0; q < 4; ++q) {
                auto const a = host_column(amount, q), d = host_column(cell, q), f = host_column(field, q),
                           v = host_column(value, q);
                EXPECT_NEAR(std::inner_product(d.begin(), d.end(), f.begin(), 0.0),
                            std::inner_product(a.begin(), a.end(), v.begin(), 0.0), 300 * rounding);
            }
        }
}

TEST(Deposit, UniformPackIsUniformUpToTheWalls)
{
    Grid const grid = box(4, 3, 5, false, true, false);
    std::vector<Vec3> lattice;
    constexpr int per_cell = 4;
    for (int k = 0; k < 5 * per_cell; ++k)
        for (int j = 0; j < 3 * per_cell; ++j)
            for (int i = 0; i < 4 * per_cell; ++i)
                lattice.push_back(grid.lower + Vec3{(i + 0.5) / per_cell * grid.spacing.x,
                                                    (j + 0.5) / per_cell * grid.spacing.y,
                                                    (k + 0.5) / per_cell * grid.spacing.z});
    Particles const particles = grains_at(lattice);
    for (Real const radius : {1e-9, 1.5e-3, 4e-3}) {
        TableView const cell("cell", grid.cell_count(), 1);
        GrainWeights const weights = weights_of(grid, radius, particles);
        deposit(weights, uniform_table(weights.entries, 1, 1), cell, 1);
        for (Real const count : host_column(cell, 0))
            EXPECT_NEAR(count / (per_cell * per_cell * per_cell), 1,
                        radius < 1e-6 ? rounding : 2e-4); // the lattice's own ripple
    }
}

TEST(Deposit, BitsDoNotDependOnTheOrderOfRows)
{
    Grid const grid = box(6, 5, 4, true, false, false);
    std::vector<Grain> grains;
    for (Vec3 const& p : random_points(grid, 3000)) {
        grains.emplace_back();
        grains.back().position = p;
        grains.back().diameter = 2e-4;
        grains.back().id = static_cast<GrainId>(grains.size());
    }
    std::vector<Real> const one = deposited(grid, 1.2e-3, make_particles(grains, {1000}), 1);
    std::vector<Real> const four = deposited(grid, 1.2e-3, make_particles(grains, {1000}), 4);
    std::shuffle(grains.begin(), grains.end(), std::mt19937_64(3));
    std::vector<Real> const shuffled_one = deposited(grid, 1.2e-3, make_particles(grains, {1000}), 1);
    std::vector<Real> const shuffled_four = deposited(grid, 1.2e-3, make_particles(grains, {1000}), 4);
    EXPECT_EQ(std::memcmp(one.data(), shuffled_one.data(), one.size() * sizeof(Real)), 0);
    EXPECT_EQ(std::memcmp(four.data(), shuffled_four.data(), four.size() * sizeof(Real)), 0);
}

/// Cells' sums grain by grain, on the host.
std::vector<Real> added_up(GrainWeights const& weights, TableView const& amount, int column)
{
    auto const weight = Kokkos::create_mirror_view_and_copy(HostSpace(), weights.weight);
    auto const first_cell = Kokkos::create_mirror_view_and_copy(HostSpace(), weights.first_cell);
    auto const value = host_column(amount, column);
    DepositStencil const& stencil = weights.stencil;
    int const* const cells = stencil.grid.cells;
    std::vector<Real> sum(stencil.grid.cell_count());
    for (int entry = 0; entry < weights.entries; ++entry) {
        int const first = first_cell(entry), code = first >= 0 ? first : -1 - first; // of a cell, or of a block
        int const nx = first >= 0 ? cells[0] : stencil.starts[0], ny = first >= 0 ? cells[1] : stencil.starts[1];
        for (int c = 0; c < stencil.slots[2]; ++c)
            for (int b = 0; b < stencil.slots[1]; ++b)
                for (int a = 0; a < stencil.slots[0]; ++a) {
                    int const i = stencil.cell(0, code % nx, a), j = stencil.cell(1, code / nx % ny, b),
                              k = stencil.cell(2, code / (nx * ny), c);
                    sum[i + cells[0] * (j + cells[1] * k)] += weight(entry, a) * weight(entry, stencil.y_slot() + b) *
                                                              weight(entry, stencil.z_slot() + c) * value[entry];
                }
    }
    return sum;
}

/// Also where a block's grains fill several chunks (one cell holds 1500 of 3000), and where blocks are empty. Here a
/// device's way is tried on a host, too.
TEST(Deposit, AddsUpEveryGrain)
{
    for (Grid const& grid : grids())
        for (Real const radius : radii)
            for (int const columns : {1, 4}) {
                std::vector<Vec3> points = random_points(grid, 3000);
                Vec3 const corner = grid.upper() - grid.spacing;
                for (std::size_t p = 0; p < points.size(); p += 2)
                    points[p] = corner + Real(0.9) * (points[p] - grid.lower) / 8;
                Particles const particles = grains_at(points);
                GrainWeights weights = weights_of(grid, radius, particles);
                weights.chunks = make_deposit_chunks(weights, weights.chunks);
                EXPECT_GE(weights.chunks.count, 3000 / 256);
                TableView const amount = table_by_id(weights, particles.id, columns);
                TableView const cell("cell", grid.cell_count(), columns), by_teams("by_teams", grid.cell_count(), columns);
                deposit(weights, amount, cell, columns);
                deposit_by_teams(weights, amount, by_teams, columns);
                for (int q = 0; q < columns; ++q) {
                    auto const one = added_up(weights, amount, q), other = host_column(cell, q),
                               third = host_column(by_teams, q);
                    for (std::size_t c = 0; c < one.size(); ++c) {
                        EXPECT_NEAR(one[c], other[c], 300 * rounding);
                        EXPECT_NEAR(one[c], third[c], 300 * rounding);
                    }
                }
            }
}

TEST(Deposit, GrainsOutsideAreLeftOutAndPeriodicOnesWrapped)
{
    Grid const grid = box(6, 5, 4, true, false, false);
    Vec3 const inside = grid.center(1, 1, 1);
    Particles const particles =
        grains_at({inside, inside + Vec3{0, 0, 1}, inside + Vec3{0, -1, 0}, inside + Vec3{grid.length(0), 0, 0}});
    GrainWeights const weights = weights_of(grid, 1e-3, particles);
    EXPECT_EQ(weights.entries, 2);
    auto const first = Kokkos::create_mirror_view_and_copy(HostSpace(), weights.first_cell);
    EXPECT_EQ(first(0), first(1));
}

TEST(Deposit, NoGrains)
{
    Grid const grid = box(3, 3, 3, false, false, false);
    TableView const cell = uniform_table(grid.cell_count(), 4, 5);
    GrainWeights const weights = weights_of(grid, 1e-3, grains_at({}));
    deposit(weights, uniform_table(0, 4, 1), cell, 4);
    EXPECT_EQ(weights.entries, 0);
    for (Real const nothing : host_column(cell, 2)) EXPECT_EQ(nothing, 0);
}

} // namespace arenite
