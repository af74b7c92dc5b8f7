// SPDX-License-Identifier: MIT
#include "apps/probes.hpp"

#include "fluid/operators.hpp"

#include <cmath>

namespace arenite {
namespace {

std::vector<std::string> columns_of(ProbeSettings const& probe)
{
    if (probe.grain)
        return {"time", "stage", "step", "x",  "y",  "z",  "vx", "vy", "vz",
                "wx",   "wy",    "wz",   "fx", "fy", "fz", "tx", "ty", "tz"};
    return {"time", "stage", "step", "u", "v", "w", "pressure", "porosity"};
}

/// Row of a grain, or -1 if it has left.
int find_row(Particles const& particles, GrainId wanted)
{
    int row = -1;
    View1<GrainId> const id = particles.id;
    Kokkos::parallel_reduce(
        "find_row", RangePolicy(0, particles.count),
        KOKKOS_LAMBDA(int i, int& found) {
            if (id(i) == wanted && i > found) found = i;
        },
        Kokkos::Max<int>(row));
    return row < 0 ? -1 : row;
}

void add_record(std::vector<Cell>& cells, RecordView const& records, int row)
{
    auto const record = Kokkos::create_mirror_view_and_copy(HostSpace(), Kokkos::subview(records, row, Kokkos::ALL));
    for (int n = 0; n < 3; ++n) cells.push_back(record(n));
}

void add_grain(std::vector<Cell>& cells, Particles const& particles, GrainId id)
{
    int const row = find_row(particles, id);
    if (row < 0) return;
    for (RecordView const& records :
         {particles.position, particles.velocity, particles.spin, particles.force, particles.torque})
        add_record(cells, records, row);
}

/// Velocity at the centre of the cell that holds the point, and the cell's pressure and porosity.
void add_cell(std::vector<Cell>& cells, Flow const& flow, Vec3 const& point)
{
    Grid const grid = flow.grid;
    int index[3];
    for (int axis = 0; axis < 3; ++axis) {
        index[axis] = static_cast<int>(std::floor((point[axis] - grid.lower[axis]) / grid.spacing[axis]));
        if (index[axis] < 0 || index[axis] >= grid.cells[axis]) return;
        index[axis] += Grid::halo;
    }
    View1<Real> const values("probe_values", 5);
    Flow const fields = flow;
    int const i = index[0], j = index[1], k = index[2];
    Kokkos::parallel_for(
        "probe_cell", RangePolicy(0, 1), KOKKOS_LAMBDA(int) {
            values(0) = Real(0.5) * (fields.velocity[0](i, j, k) + fields.velocity[0](i + 1, j, k));
            values(1) = Real(0.5) * (fields.velocity[1](i, j, k) + fields.velocity[1](i, j + 1, k));
            values(2) = Real(0.5) * (fields.velocity[2](i, j, k) + fields.velocity[2](i, j, k + 1));
            values(3) = fields.pressure(i, j, k);
            values(4) = fields.porosity(i, j, k);
        });
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), values);
    for (int n = 0; n < 5; ++n) cells.push_back(host(n));
}

} // namespace

Probes::Probes(std::filesystem::path const& folder, OutputSettings const& output, std::optional<ResumePoint> const& resume)
{
    for (ProbeSettings const& probe : output.probes)
        probes_.push_back(
            {probe, TimeSeries(folder / ("probe-" + probe.name + ".csv"), columns_of(probe), rows_until(resume))});
}

void Probes::write(RunState const& state, std::string const& stage)
{
    for (Probe& probe : probes_) {
        std::vector<Cell> cells{state.clock.time(), stage, state.clock.step};
        if (probe.settings.grain) add_grain(cells, state.particles, *probe.settings.grain);
        else if (state.fluid) add_cell(cells, state.fluid->flow, *probe.settings.point);
        cells.resize(probe.table.columns().size());
        probe.table.add(cells);
    }
}

void Probes::flush()
{
    for (Probe& probe : probes_) probe.table.flush();
}

} // namespace arenite
