// SPDX-License-Identifier: MIT
// From a scene file to a Scene that is complete and makes sense, or to a list of everything that is wrong.
#pragma once

#include "core/scene.hpp"
#include "io/grain_csv.hpp"

#include <string>
#include <vector>

namespace arenite {

/// Reads, completes and checks a scene. overrides: "table.key=value", as of --set.
/// Throws InputError with every fault, one a line.
Scene read_scene(std::string const& path, std::vector<std::string> const& overrides = {});

/// The same from text; `path` is for messages and for the files that the scene names.
Scene read_scene_text(std::string const& text, std::string const& path, std::vector<std::string> const& overrides = {});

/// The scene as TOML with every default filled in; reads back as the same scene. In Scene::resolved too.
std::string resolved_scene(Scene const& scene);

/// FNV-1a, 64 bits.
unsigned long long hash_of(std::string const& text);

/// Where a file that the scene names is: relative names are relative to the scene file.
std::string path_of(Scene const& scene, std::string const& file);

/// The grains of a scene whose source is a CSV file.
GrainTable grains_of_file(Scene const& scene);

/// Row of a material in Scene::materials, -1 if there is none of that name.
int material_row(Scene const& scene, std::string const& name);

/// The markdown reference of every key, as docs/scene.md has it after this line.
inline constexpr char const* scene_reference_marker = "<!-- generated from io/scene: do not edit below -->";
std::string scene_reference();

} // namespace arenite
