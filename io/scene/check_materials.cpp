// SPDX-License-Identifier: MIT
// Nothing is mixed in silence: where two materials that touch differ in a value that belongs to the
// pair, an interactions entry has to say what holds. (The surface energy of an unlike pair is the
// common value, or 0 where the two differ: unlike matter does not stick unless the scene says so.)
#include "io/scene/check.hpp"

#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <set>

namespace arenite::scene {
namespace {

void check_interactions(Scene const& scene, std::vector<InteractionSettings> const& list, std::string const& path,
                        Faults& faults)
{
    for (std::size_t i = 0; i < list.size(); ++i) {
        std::string const where = element(path, i);
        if (!faults.given(where + ".materials")) continue;
        for (std::string const& name : list[i].materials)
            check_name(name, names_of(scene.materials), "material", where + ".materials", faults);
        if (find_interaction(list, list[i].materials[0], list[i].materials[1]) != &list[i])
            faults.add(where + ".materials", "an earlier entry names the same pair");
    }
}

MaterialSettings const& stage_material(StageSettings const& stage, MaterialSettings const& material)
{
    auto const found = stage.materials.find(material.name);
    return found == stage.materials.end() ? material : found->second;
}

void check_pair(Scene const& scene, StageSettings const& stage, std::string const& stage_path, MaterialSettings const& first,
                MaterialSettings const& second, ContactSettings law, Faults& faults)
{
    MaterialSettings const &a = stage_material(stage, first), &b = stage_material(stage, second);
    InteractionSettings const* entry = find_interaction(stage.interactions, a.name, b.name);
    if (!entry) entry = find_interaction(scene.interactions, a.name, b.name);
    if (entry && entry->contact) law = *entry->contact;
    auto const differ = [&](char const* key, Real of_a, Real of_b) {
        std::string path = "materials." + b.name;
        for (std::string const& name : {a.name, b.name})
            if (stage.materials.count(name)) path = stage_path + ".materials." + name;
        faults.add(path, fmt::format("{0} and {1} touch but differ in {2} ({3} and {4}): say what holds between them, "
                                     "[[interactions]] materials = [\"{0}\", \"{1}\"], {2} = ...",
                                     a.name, b.name, key, of_a, of_b));
    };
    if (law.damping != DampingLaw::none && a.restitution != b.restitution && !(entry && entry->restitution))
        differ("restitution", a.restitution, b.restitution);
    if (law.tangential != TangentialLaw::none && a.friction != b.friction && !(entry && entry->friction))
        differ("friction", a.friction, b.friction);
}

void check_pairs(Scene const& scene, std::size_t stage_index, std::vector<int> const& grains, std::set<int> const& walls,
                 Faults& faults)
{
    StageSettings const& stage = scene.stages[stage_index];
    std::string const path = element("stages", stage_index, stage.name);
    auto const material = [&scene](int row) -> MaterialSettings const& {
        return scene.materials[static_cast<std::size_t>(row)];
    };
    for (int const grain : grains) {
        for (int const other : grains)
            if (grain < other) check_pair(scene, stage, path, material(grain), material(other), stage.contact, faults);
        for (int const wall : walls)
            check_pair(scene, stage, path, material(grain), material(wall), stage.wall_contact, faults);
    }
}

} // namespace

void check_materials(Scene const& scene, std::vector<int> const& grain_materials, Faults& faults)
{
    for (int const row : grain_materials) {
        MaterialSettings const& m = scene.materials[static_cast<std::size_t>(row)];
        if (!(m.density > 0) && !faults.any_faulty({"materials." + m.name + ".density"}))
            faults.add("materials." + m.name, "missing key density [kg/m3]: grains are made of this material");
        if (m.rigid) faults.add("materials." + m.name + ".rigid", "grains are made of this material and must deform");
    }
    constexpr std::size_t most = 255; // a grain keeps the row of its material in a byte
    if (scene.materials.size() > most)
        faults.add("materials", fmt::format("are {}, more than the {} that a run can have", scene.materials.size(), most));
    check_interactions(scene, scene.interactions, "interactions", faults);
    std::set<int> walls;
    for (WallSettings const& wall : scene.walls)
        if (int const row = material_row(scene, wall.material); row >= 0) walls.insert(row);
    for (std::size_t i = 0; i < scene.stages.size(); ++i) {
        StageSettings const& stage = scene.stages[i];
        std::string const path = element("stages", i, stage.name);
        check_interactions(scene, stage.interactions, path + ".interactions", faults);
        for (auto const& [name, material] : stage.materials) {
            if (!check_name(name, names_of(scene.materials), "material", path + ".materials." + name, faults)) continue;
            // Where the scene's material lacks it, that is said already.
            bool const was_rigid = scene.materials[static_cast<std::size_t>(material_row(scene, name))].rigid;
            if (was_rigid && !material.rigid && !(material.youngs_modulus > 0))
                faults.add(path + ".materials." + name, "needs youngs_modulus and poissons_ratio if it is not rigid");
        }
        check_pairs(scene, i, grain_materials, walls, faults);
    }
}

} // namespace arenite::scene
