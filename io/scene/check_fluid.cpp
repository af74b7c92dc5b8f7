// SPDX-License-Identifier: MIT
#include "io/scene/check.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace arenite::scene {
namespace {

constexpr std::array<char const*, 6> face_names{"x_lower", "x_upper", "y_lower", "y_upper", "z_lower", "z_upper"};

void check_steps(Scene const& scene, FluidSettings const& f, Faults& faults)
{
    bool const grains = scene.particles.source != ParticleSource::none;
    if (faults.any_faulty({"fluid.time_step", "fluid.coupling_interval"})) return;
    if (f.time_step > 0 && f.coupling_interval > 0)
        faults.add("fluid.coupling_interval", "stands beside time_step: give one of them");
    else if (!(f.time_step > 0) && f.coupling_interval == 0)
        faults.add("fluid",
                   grains ? "missing key time_step [s] or coupling_interval [grain steps]" : "missing key time_step [s]");
    else if (!grains && f.coupling_interval > 0)
        faults.add("fluid.coupling_interval", "there are no grains: give time_step");
}

void check_fit_wall(Scene const& scene, FluidSettings const& f, Faults& faults)
{
    if (f.fit_wall.empty()) return;
    if (!check_name(f.fit_wall, names_of(scene.walls), "wall", "fluid.fit_wall", faults)) return;
    WallSettings const& wall = *find_wall(scene, f.fit_wall);
    int const components = (wall.normal.x != 0) + (wall.normal.y != 0) + (wall.normal.z != 0);
    if (wall.shape != WallShape::plane || components != 1)
        faults.add("fluid.fit_wall", "must be a plane whose normal is along x, y or z");
}

/// A patch beside its face would be none.
void check_place(PatchSettings const& p, Region const& box, std::string const& path, Faults& faults)
{
    int const normal = static_cast<int>(p.face) / 2;
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == normal || p.shape == PatchShape::face) continue;
        bool const disc = p.shape == PatchShape::disc;
        Real const low = disc ? p.center[axis] - p.diameter / 2 : p.rectangle.lower[axis],
                   high = disc ? p.center[axis] + p.diameter / 2 : p.rectangle.upper[axis];
        if (low < box.upper[axis] && high > box.lower[axis]) continue;
        return faults.add(path,
                          fmt::format("lies beside its face: along {} it goes from {:g} to {:g} m, the fluid's box from "
                                      "{:g} to {:g} m",
                                      "xyz"[axis], low, high, box.lower[axis], box.upper[axis]));
    }
}

void check_patch(PatchSettings const& p, std::string const& path, Faults& faults)
{
    if (p.kind == PatchKind::periodic && p.shape != PatchShape::face)
        faults.add(path + ".shape", "a periodic patch is the whole face");
    if (p.shape != PatchShape::rectangle || !faults.given(path + ".lower") || !faults.given(path + ".upper")) return;
    int const normal = static_cast<int>(p.face) / 2;
    for (int axis = 0; axis < 3; ++axis)
        if (axis != normal && !(p.rectangle.lower[axis] < p.rectangle.upper[axis]))
            faults.add(path + ".upper", fmt::format("must be above lower along {}", "xyz"[axis]));
}

/// What holds on the whole of each face, and whether it is covered by anything else.
void check_periodic_faces(Scene const& scene, FluidSettings const& f, Faults& faults)
{
    std::array<bool, 6> periodic{}, other{};
    for (PatchSettings const& p : f.patches)
        (p.kind == PatchKind::periodic ? periodic : other)[static_cast<std::size_t>(p.face)] = true;
    for (std::size_t i = 0; i < f.patches.size(); ++i) {
        std::size_t const face = static_cast<std::size_t>(f.patches[i].face);
        std::string const path = element("fluid.patches", i);
        if (f.patches[i].kind == PatchKind::periodic && !periodic[face ^ 1])
            faults.add(path,
                       fmt::format("{} is periodic, so {} must be periodic too", face_names[face], face_names[face ^ 1]));
        if (periodic[face] && f.patches[i].kind != PatchKind::periodic)
            faults.add(path, fmt::format("{} is periodic and can carry no other patch", face_names[face]));
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (scene.domain.periodic[axis] && !(periodic[2 * axis] && periodic[2 * axis + 1]))
            faults.add(
                "fluid",
                fmt::format("the domain is periodic along {}: add [[fluid.patches]] with type = \"periodic\" for {} and {}",
                            "xyz"[axis], face_names[2 * axis], face_names[2 * axis + 1]));
}

} // namespace

void check_fluid(Scene const& scene, Faults& faults)
{
    if (!scene.fluid) return;
    FluidSettings const& f = *scene.fluid;
    check_steps(scene, f, faults);
    // The number of a face is an int, and so is that of a node: a cell more on either side of each axis, and a face.
    constexpr Real most = 2147483647.0 / 3;
    Real const nodes = Real(f.cells[0] + 5) * (f.cells[1] + 5) * (f.cells[2] + 5);
    if (nodes > most)
        faults.add("fluid.cells",
                   fmt::format("are {:.3g} nodes with those of the boundary, more than the {:.3g} that a run can have",
                               nodes, most));
    if (f.box) check_region(*f.box, "fluid.box", faults);
    for (int axis = 0; f.box && axis < 3; ++axis)
        if (scene.domain.periodic[static_cast<std::size_t>(axis)] &&
            (f.box->lower[axis] != scene.domain.lower[axis] || f.box->upper[axis] != scene.domain.upper[axis]))
            faults.add("fluid.box",
                       fmt::format("must reach from face to face of the domain along {}, which is periodic", "xyz"[axis]));
    bool const needs_reynolds = f.drag != DragLaw::none && f.drag != DragLaw::stokes && f.drag != DragLaw::constant;
    if (scene.particles.source != ParticleSource::none && needs_reynolds && f.viscosity == 0 &&
        !faults.any_faulty({"fluid.viscosity"}))
        faults.add("fluid.viscosity",
                   "is 0, and this drag law needs a Reynolds number: choose drag = \"none\" or a viscosity");
    check_fit_wall(scene, f, faults);
    Region const box = f.box.value_or(Region{scene.domain.lower, scene.domain.upper});
    bool const box_is_sound = !faults.any_faulty({"fluid.box", "domain.lower", "domain.upper"});
    for (std::size_t i = 0; i < f.patches.size(); ++i) {
        std::string const path = element("fluid.patches", i);
        check_patch(f.patches[i], path, faults);
        if (box_is_sound && !faults.any_faulty({path + ".center", path + ".diameter", path + ".lower", path + ".upper"}))
            check_place(f.patches[i], box, path, faults);
    }
    check_periodic_faces(scene, f, faults);
}

} // namespace arenite::scene
