// SPDX-License-Identifier: MIT
#include "io/snapshots.hpp"

namespace arenite {
namespace {

/// The first three columns of the owned rows.
std::vector<Real> vectors_of(RecordView const& records, int count)
{
    if (!records.is_allocated()) return {};
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), rows_of(records, 0, count));
    std::vector<Real> result(3 * std::size_t(count));
    for (int i = 0; i < count; ++i)
        for (int c = 0; c < 3; ++c) result[3 * std::size_t(i) + c] = host(i, c);
    return result;
}

/// The first `count` values, as numbers of type T.
template <class T, class ViewType> std::vector<T> values_of(ViewType const& view, int count)
{
    if (!view.is_allocated()) return {};
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), rows_of(view, 0, count));
    std::vector<T> result(count);
    for (int i = 0; i < count; ++i) result[i] = static_cast<T>(host(i));
    return result;
}

std::vector<Real> diameters_of(RecordView const& position, int count)
{
    auto const radii = Kokkos::subview(position, Kokkos::make_pair(0, count), 3);
    View1<Real> packed(uninitialized("radii"), count); // strided columns do not copy between spaces
    Kokkos::deep_copy(packed, radii);
    auto result = values_of<Real>(packed, count);
    for (Real& value : result) value *= 2;
    return result;
}

/// A field of cell values, or the mean over the two faces of each cell normal to `axis`.
template <class HostField> void copy_cells(Grid const& grid, HostField const& field, int axis, Real* out, int stride)
{
    int const h = Grid::halo, dx = axis == 0, dy = axis == 1, dz = axis == 2;
    for (int k = 0; k < grid.cells[2]; ++k)
        for (int j = 0; j < grid.cells[1]; ++j)
            for (int i = 0; i < grid.cells[0]; ++i, out += stride) {
                Real const value = field(i + h, j + h, k + h);
                *out = axis < 0 ? value : (value + field(i + h + dx, j + h + dy, k + h + dz)) / 2;
            }
}

} // namespace

GrainSnapshot take_snapshot(Particles const& particles, Real time, GrainCounts const& counts)
{
    int const count = particles.count;
    GrainSnapshot snapshot;
    snapshot.time = time;
    snapshot.position = vectors_of(particles.position, count);
    snapshot.diameter = diameters_of(particles.position, count);
    snapshot.velocity = vectors_of(particles.velocity, count);
    snapshot.spin = vectors_of(particles.spin, count);
    snapshot.force = vectors_of(particles.force, count);
    snapshot.torque = vectors_of(particles.torque, count);
    snapshot.fluid_force = vectors_of(particles.fluid_force, count);
    snapshot.bonds = values_of<int>(counts.bonds, count);
    snapshot.coordination = values_of<int>(counts.coordination, count);
    snapshot.size_class = values_of<int>(particles.size_class, count);
    snapshot.material = values_of<int>(particles.material, count);
    snapshot.id = values_of<std::int64_t>(particles.id, count);
    return snapshot;
}

FluidSnapshot take_snapshot(Flow const& flow, Real time)
{
    Grid const& grid = flow.grid;
    FluidSnapshot snapshot;
    snapshot.time = time;
    for (int axis = 0; axis < 3; ++axis) snapshot.cells[axis] = grid.cells[axis];
    snapshot.lower = grid.lower;
    snapshot.spacing = grid.spacing;
    std::size_t const count = grid.cell_count();
    snapshot.velocity.resize(3 * count);
    snapshot.pressure.resize(count);
    snapshot.porosity.resize(count);
    for (int axis = 0; axis < 3; ++axis)
        copy_cells(grid, Kokkos::create_mirror_view_and_copy(HostSpace(), flow.velocity[axis]), axis,
                   snapshot.velocity.data() + axis, 3);
    copy_cells(grid, Kokkos::create_mirror_view_and_copy(HostSpace(), flow.pressure), -1, snapshot.pressure.data(), 1);
    copy_cells(grid, Kokkos::create_mirror_view_and_copy(HostSpace(), flow.porosity), -1, snapshot.porosity.data(), 1);
    return snapshot;
}

} // namespace arenite
