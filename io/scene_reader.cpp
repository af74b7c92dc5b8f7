// SPDX-License-Identifier: MIT
#include "io/scene_reader.hpp"

#include "core/error.hpp"
#include "io/scene/check.hpp"
#include "io/scene/read_table.hpp"
#include "io/scene/write.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace arenite {
namespace {

Scene build_scene(SceneNode root, std::string const& path, std::vector<std::string> const& overrides)
{
    scene::Faults faults;
    for (std::string const& assignment : overrides) {
        try {
            apply_override(root, assignment);
        } catch (InputError const& error) {
            faults.add_line(error.what());
        }
    }
    Scene result;
    result.path = path;
    scene::read_table(root, scene::scene_fields(result), "", faults);
    faults.values_are_read();
    scene::complete(result, faults);
    scene::check(result, faults);
    faults.throw_if_any();
    result.resolved = resolved_scene(result);
    result.hash = hash_of(result.resolved);
    return result;
}

} // namespace

Scene read_scene(std::string const& path, std::vector<std::string> const& overrides)
{
    return build_scene(load_scene_file(path), path, overrides);
}

Scene read_scene_text(std::string const& text, std::string const& path, std::vector<std::string> const& overrides)
{
    return build_scene(parse_scene(text, path), path, overrides);
}

std::string resolved_scene(Scene const& scene)
{
    Scene copy = scene; // the table of keys points to values that may change
    return "# The scene with every default filled in. SI units.\n" + scene::write_table(scene::scene_fields(copy), "");
}

unsigned long long hash_of(std::string const& text)
{
    unsigned long long hash = 14695981039346656037ull;
    for (char const c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
    return hash;
}

std::string path_of(Scene const& scene, std::string const& file)
{
    return (std::filesystem::path(scene.path).parent_path() / file).lexically_normal().string();
}

GrainTable grains_of_file(Scene const& scene)
{
    std::vector<std::string> names;
    for (MaterialSettings const& material : scene.materials) names.push_back(material.name);
    return read_grain_csv(path_of(scene, scene.particles.file), names, material_row(scene, scene.particles.material));
}

int material_row(Scene const& scene, std::string const& name)
{
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].name == name) return static_cast<int>(i);
    return -1;
}

std::string scene_reference() { return scene::document_tables(); }

} // namespace arenite
