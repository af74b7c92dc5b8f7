// SPDX-License-Identifier: MIT
// What the fluid's checks and tests share: a flow with its boundary and solver, fields set and read on the host,
// and observed orders.
#pragma once

#include "fluid/advance_flow.hpp"

#include <cmath>
#include <functional>

namespace arenite {

struct FluidCase {
    Flow flow;
    FlowBoundary boundary;
    FlowSolver solver;

    FlowReport step(Real dt) { return advance_flow(flow, boundary, solver, dt); }
    FlowReport steps(int count, Real dt)
    {
        FlowReport report;
        for (int s = 0; s < count; ++s) report = step(dt);
        return report;
    }
};

inline FluidCase make_fluid_case(FluidSettings const& settings, bool with_grains)
{
    FluidCase c;
    c.flow = make_flow(settings, settings.box.value(), with_grains, Vec3{});
    c.boundary = make_boundary(settings, c.flow.grid);
    c.solver = make_flow_solver(settings, c.flow);
    return c;
}

inline PatchSettings face_patch(Face face, PatchKind kind, Vec3 velocity = {}, Real pressure = 0)
{
    PatchSettings patch;
    patch.face = face;
    patch.kind = kind;
    patch.velocity = velocity;
    patch.pressure = pressure;
    return patch;
}

inline void add_periodic_axis(FluidSettings& settings, int axis)
{
    settings.patches.push_back(face_patch(static_cast<Face>(2 * axis), PatchKind::periodic));
    settings.patches.push_back(face_patch(static_cast<Face>(2 * axis + 1), PatchKind::periodic));
}

inline FluidSettings box_settings(std::array<int, 3> cells, Vec3 size)
{
    FluidSettings settings;
    settings.cells = cells;
    settings.box = Region{{0, 0, 0}, size};
    settings.gravity = false;
    settings.convection = ConvectionScheme::none;
    return settings;
}

using HostField = Kokkos::View<Real***, Kokkos::LayoutLeft, HostSpace>;

inline HostField host_copy(FieldView const& field)
{
    HostField host("host_copy", field.extent(0), field.extent(1), field.extent(2));
    Kokkos::deep_copy(host, field);
    return host;
}

/// Value of a cell (or face) addressed without the halo.
inline Real value_of(HostField const& field, int i, int j, int k)
{
    return field(i + Grid::halo, j + Grid::halo, k + Grid::halo);
}

/// Sets every entry, halo and last faces included, to f(position); face_axis -1: at the cells.
inline void set_field(Grid const& grid, FieldView const& field, int face_axis, std::function<Real(Vec3)> const& f)
{
    HostField host("set_field", field.extent(0), field.extent(1), field.extent(2));
    for (int k = 0; k < grid.allocated(2); ++k)
        for (int j = 0; j < grid.allocated(1); ++j)
            for (int i = 0; i < grid.allocated(0); ++i) {
                Vec3 x = grid.center(i - Grid::halo, j - Grid::halo, k - Grid::halo);
                if (face_axis >= 0) x[face_axis] -= grid.spacing[face_axis] / 2;
                host(i, j, k) = f(x);
            }
    Kokkos::deep_copy(field, host);
}

struct FieldErrors {
    Real rms = 0, largest = 0, mean = 0; // of field - f; mean keeps the sign
};

inline FieldErrors errors_of(Grid const& grid, FieldView const& field, int face_axis, std::function<Real(Vec3)> const& f)
{
    HostField const host = host_copy(field);
    FieldErrors errors;
    for (int k = 0; k < grid.cells[2]; ++k)
        for (int j = 0; j < grid.cells[1]; ++j)
            for (int i = 0; i < grid.cells[0]; ++i) {
                Vec3 x = grid.center(i, j, k);
                if (face_axis >= 0) x[face_axis] -= grid.spacing[face_axis] / 2;
                Real const error = value_of(host, i, j, k) - f(x);
                errors.rms += error * error;
                errors.mean += error;
                errors.largest = std::fmax(errors.largest, std::fabs(error));
            }
    errors.rms = std::sqrt(errors.rms / grid.cell_count());
    errors.mean /= grid.cell_count();
    return errors;
}

/// Slope of the error when the step is halved.
inline Real observed_order(Real coarse_error, Real fine_error) { return std::log2(coarse_error / fine_error); }

} // namespace arenite
