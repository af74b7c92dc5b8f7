// SPDX-License-Identifier: MIT
#include "fluid/boundary.hpp"

#include "core/error.hpp"
#include "fluid/patch_area.hpp"

#include <fmt/format.h>

#include <cmath>

namespace arenite {
namespace {

constexpr char const* face_names[6] = {"x_lower", "x_upper", "y_lower", "y_upper", "z_lower", "z_upper"};

int axis_of(PatchSettings const& patch) { return static_cast<int>(patch.face) / 2; }
int side_of(PatchSettings const& patch) { return static_cast<int>(patch.face) % 2; }
char const* name_of(PatchSettings const& patch) { return face_names[static_cast<int>(patch.face)]; }

FaceRectangle cell_rectangle(Grid const& grid, int axis, int a, int b)
{
    int const along[2] = {first_transverse(axis), second_transverse(axis)}, at[2] = {a, b};
    FaceRectangle face{};
    for (int d = 0; d < 2; ++d) {
        face.lower[d] = grid.lower[along[d]] + at[d] * grid.spacing[along[d]];
        face.upper[d] = grid.lower[along[d]] + (at[d] + 1) * grid.spacing[along[d]];
    }
    return face;
}

/// Share of a boundary face that lies under the patch, 0 to 1.
Real covered_share(PatchSettings const& patch, Grid const& grid, int a, int b)
{
    if (patch.shape == PatchShape::face) return 1;
    int const axis = axis_of(patch), along[2] = {first_transverse(axis), second_transverse(axis)};
    FaceRectangle const face = cell_rectangle(grid, axis, a, b);
    Real area = 0;
    if (patch.shape == PatchShape::disc) {
        Real const center[2] = {patch.center[along[0]], patch.center[along[1]]};
        area = disc_area_in_rectangle(center, patch.diameter / 2, face);
    } else {
        FaceRectangle rectangle{};
        for (int d = 0; d < 2; ++d) {
            rectangle.lower[d] = patch.rectangle.lower[along[d]];
            rectangle.upper[d] = patch.rectangle.upper[along[d]];
        }
        area = rectangle_area_in_rectangle(rectangle, face);
    }
    Real const share = area / grid.face_area(axis);
    constexpr Real rounding = 1e-13; // of the difference of four quadrant areas: neither a sliver nor a gap
    return share < rounding ? 0 : (share > 1 - rounding ? 1 : share);
}

void lay_patch(PatchSettings const& patch, Real share, BoundaryFace& face)
{
    if (share <= 0) return;
    int const axis = axis_of(patch);
    Real const below = 1 - share, open_below = below * face.open;
    bool const sticks = patch.kind == PatchKind::wall || patch.kind == PatchKind::velocity;
    Vec3 tangential = patch.velocity;
    tangential[axis] = 0;

    face.open = open_below + (patch.kind == PatchKind::pressure ? share : 0);
    if (patch.kind == PatchKind::pressure) face.pressure = (open_below * face.pressure + share * patch.pressure) / face.open;
    face.flux = below * face.flux + (patch.kind == PatchKind::velocity ? share * patch.velocity[axis] : 0);
    face.stick = below * face.stick + (sticks ? share : 0);
    face.wall_velocity = below * face.wall_velocity + (patch.kind == PatchKind::wall ? share : 0) * tangential;
    face.inlet_velocity = below * face.inlet_velocity + (patch.kind == PatchKind::velocity ? share : 0) * tangential;
}

/// One fault of a patch, or nothing.
std::string fault_of(PatchSettings const& patch, Grid const& grid)
{
    if (patch.kind == PatchKind::periodic)
        return patch.shape == PatchShape::face
                   ? ""
                   : fmt::format("fluid patch on {}: periodic holds for a whole face", name_of(patch));
    if (grid.periodic[axis_of(patch)])
        return fmt::format("fluid patch on {}: the face is periodic, nothing can lie on it", name_of(patch));
    if (patch.shape == PatchShape::disc && !(patch.diameter > 0))
        return fmt::format("fluid patch on {}: a disc needs a diameter above 0", name_of(patch));
    if (patch.kind == PatchKind::wall && patch.velocity[axis_of(patch)] != 0)
        return fmt::format("fluid patch on {}: a wall of the fluid box can only move along itself; use kind velocity "
                           "for flow through it",
                           name_of(patch));
    return "";
}

void require_sound(std::vector<PatchSettings> const& patches, Grid const& grid)
{
    std::string faults;
    for (PatchSettings const& patch : patches) {
        std::string const fault = fault_of(patch, grid);
        if (!fault.empty()) faults += (faults.empty() ? "" : "\n") + fault;
    }
    if (!faults.empty()) throw InputError(faults);
}

/// Inflow and outflow that the patches prescribe, m3/s; without an opening they have to be equal.
void require_balance(Real inflow, Real outflow)
{
    constexpr Real rounding = 1e-10;
    if (std::abs(inflow - outflow) <= rounding * std::max(inflow, outflow)) return;
    throw InputError(fmt::format("fluid patches: {:g} m3/s flow in and {:g} m3/s flow out, and no pressure patch "
                                 "lets the fluid make up the difference",
                                 inflow, outflow));
}

} // namespace

void set_periodic_axes(FluidSettings const& settings, Grid& grid)
{
    bool periodic[6] = {};
    for (PatchSettings const& patch : settings.patches)
        periodic[static_cast<int>(patch.face)] = patch.kind == PatchKind::periodic;
    std::string faults;
    for (int axis = 0; axis < 3; ++axis) {
        grid.periodic[axis] = periodic[2 * axis] && periodic[2 * axis + 1];
        if (periodic[2 * axis] == periodic[2 * axis + 1]) continue;
        int const lone = periodic[2 * axis] ? 2 * axis : 2 * axis + 1;
        faults += fmt::format("{}fluid patch on {}: periodic, but {} is not", faults.empty() ? "" : "\n", face_names[lone],
                              face_names[lone ^ 1]);
    }
    if (!faults.empty()) throw InputError(faults);
}

FlowBoundary make_boundary(FluidSettings const& settings, Grid const& grid)
{
    require_sound(settings.patches, grid);
    FlowBoundary boundary;
    Real inflow = 0, outflow = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (grid.periodic[axis]) continue;
        for (int side = 0; side < 2; ++side) {
            int const na = grid.cells[first_transverse(axis)], nb = grid.cells[second_transverse(axis)];
            boundary.faces[axis][side] = BoundaryFaceView("boundary_faces", na, nb);
            auto const faces = Kokkos::create_mirror_view(boundary.faces[axis][side]);
            for (int b = 0; b < nb; ++b) {
                for (int a = 0; a < na; ++a) {
                    BoundaryFace face;
                    for (PatchSettings const& patch : settings.patches)
                        if (axis_of(patch) == axis && side_of(patch) == side)
                            lay_patch(patch, covered_share(patch, grid, a, b), face);
                    faces(a, b) = face;
                    boundary.has_pressure = boundary.has_pressure || face.open > 0;
                    Real const inward = (side == 0 ? 1 : -1) * face.flux * grid.face_area(axis);
                    (inward > 0 ? inflow : outflow) += std::abs(inward);
                }
            }
            Kokkos::deep_copy(boundary.faces[axis][side], faces);
        }
    }
    if (!boundary.has_pressure) require_balance(inflow, outflow);
    return boundary;
}

} // namespace arenite
