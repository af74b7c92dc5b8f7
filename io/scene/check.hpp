// SPDX-License-Identifier: MIT
// What one key alone cannot tell: defaults that depend on other keys, and whether the tables fit together.
#pragma once

#include "io/scene/faults.hpp"

#include "core/scene.hpp"

#include <string>
#include <vector>

namespace arenite::scene {

/// Fills what follows from other keys: break points, the classes of a lognormal, stage interactions.
void complete(Scene& scene, Faults& faults);

/// Everything below, in the order of the file.
void check(Scene const& scene, Faults& faults);

/// Returns the rows of the materials that grains are made of.
std::vector<int> check_grains(Scene const& scene, Faults& faults);
void check_materials(Scene const& scene, std::vector<int> const& grain_materials, Faults& faults);
void check_walls(Scene const& scene, Faults& faults);
/// Walls that are present at the start and whose solid bodies overlap.
void check_wall_overlaps(Scene const& scene, Faults& faults);
void check_fluid(Scene const& scene, Faults& faults);
void check_stages(Scene const& scene, Faults& faults);
void check_output(Scene const& scene, Faults& faults);

/// lower < upper on every axis.
void check_region(Region const& region, std::string const& path, Faults& faults);

/// The path of element i of a list, as read_table made it.
std::string element(std::string const& list, std::size_t i, std::string const& name = {});

/// A fault unless one of `names` is `name`. what: "wall", "material".
bool check_name(std::string const& name, std::vector<std::string> const& names, std::string const& what,
                std::string const& path, Faults& faults);

template <class List> std::vector<std::string> names_of(List const& list)
{
    std::vector<std::string> names;
    for (auto const& item : list) names.push_back(item.name);
    return names;
}

/// False too for a name that no file can have.
bool is_file(std::string const& path);

WallSettings const* find_wall(Scene const& scene, std::string const& name);

/// The entry of a pair, in either order, or null.
InteractionSettings const* find_interaction(std::vector<InteractionSettings> const& list, std::string const& a,
                                            std::string const& b);

} // namespace arenite::scene
