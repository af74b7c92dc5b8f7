// SPDX-License-Identifier: MIT
// Every key that a scene may hold, taken from the reader's own tables, with the text of a scene in which the key can be
// written, right or wrong.
#pragma once

#include "io/scene/schema.hpp"

#include <string>
#include <vector>

namespace arenite::test {

struct SceneKey {
    std::string header;  // TOML that opens the key's table and gives the key a meaning there
    std::string table;   // path of the table as messages write it; "" for the top level
    std::string heading; // the same as docs/scene.md writes it: [domain], [[walls.holes]], [materials.NAME]
    scene::Field field;
    std::vector<std::string> siblings; // all names of the table

    std::string path() const { return table.empty() ? field.name : table + "." + field.name; }
};

/// Tables before and after what they hold.
std::vector<SceneKey> every_scene_key();

/// A scene that writes `name` = `value` in the key's table, and the place of that in messages.
struct WrittenKey {
    std::string text, name_place, value_place;
};
WrittenKey write_key(SceneKey const& key, std::string const& name, std::string const& value);

/// TOML values of other types than the key's.
std::vector<std::string> values_of_wrong_type(SceneKey const& key);

/// Numbers just outside the key's range, on either side where it has an end; scalars, see as_value.
std::vector<std::string> values_out_of_range(SceneKey const& key);

/// The value that a scalar stands for in a key's type: itself, [v, v, v], [v].
std::string as_value(SceneKey const& key, std::string const& scalar);

/// True for keys that hold whole numbers, and for those that hold numbers of any kind.
bool holds_integers(SceneKey const& key);
bool holds_numbers(SceneKey const& key);

/// One slip of the keyboard: the middle letter twice.
std::string misspelled(std::string const& word);

} // namespace arenite::test
