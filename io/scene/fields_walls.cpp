// SPDX-License-Identifier: MIT
#include "io/scene/schema.hpp"

namespace arenite::scene {
namespace {

Fields hole_fields(HoleSettings& h)
{
    return {
        required({"name", &h.name, "", "of your choice"}),
        required({"center", &h.center, "m", "projected on the plane"}),
        required({"diameter", &h.diameter, "m", "of the hole", positive()}),
    };
}

} // namespace

Fields wall_fields(WallSettings& w)
{
    auto const is = [&w](WallShape shape) { return [&w, shape] { return w.shape == shape; }; };
    auto const has_inside = [&w] { return w.shape == WallShape::cylinder || w.shape == WallShape::box; };
    std::string const plane = "type = \"plane\"", cylinder = "type = \"cylinder\"", box = "type = \"box\"",
                      mesh = "type = \"mesh\"";
    auto const of_plane = is(WallShape::plane); // one a line: nvcc cannot declare several of a lambda's type at once
    auto const of_cylinder = is(WallShape::cylinder);
    auto const of_box = is(WallShape::box);
    auto const of_mesh = is(WallShape::mesh);
    return {
        required({"name", &w.name, "", "of your choice"}),
        required({"type", choice(w.shape, {"plane", "cylinder", "box", "mesh"}), "", "shape of the wall"}),
        required({"material", &w.material, "", "name of its material"}),
        {"present", &w.present, "", "there at the start; stages add and remove"},
        required(only_when(of_plane, plane, {"point", &w.point, "m", "a point of the plane"})),
        required(only_when(of_plane, plane, {"normal", &w.normal, "", "towards the grains, of any length but 0"})),
        only_when(of_plane, plane, {"holes", list_of(w.holes, hole_fields, "name"), "", "closed until a stage opens them"}),
        required(only_when(of_cylinder, cylinder, {"base", &w.base, "m", "centre of the lower end"})),
        required(only_when(of_cylinder, cylinder, {"axis", &w.axis, "m", "from the base to the other end"})),
        required(only_when(of_cylinder, cylinder, {"diameter", &w.diameter, "m", "of the cylinder", positive()})),
        required(only_when(of_box, box, {"lower", &w.box.lower, "m", "lower corner"})),
        required(only_when(of_box, box, {"upper", &w.box.upper, "m", "upper corner"})),
        only_when(has_inside, "type = \"cylinder\" or \"box\"",
                  {"inside", &w.inside, "", "true: a tube or vessel with the grains inside; false: a rod or block"}),
        required(only_when(
            of_mesh, mesh,
            {"file", &w.file, "",
             "STL file, relative to the scene file; corners go counter-clockwise seen from the grains (the normals that "
             "the file writes are not looked at)"})),
        only_when(of_mesh, mesh, {"scale", &w.scale, "", "of the file's lengths: 0.001 for a file in mm", positive()}),
        only_when(of_mesh, mesh, {"offset", &w.offset, "m", "added after scaling"}),
    };
}

} // namespace arenite::scene
