// SPDX-License-Identifier: MIT
// A TOML file as a plain tree in which every value knows where it was written. toml++ stays behind
// this header: nothing else of the project sees it. Knows nothing about what the keys mean.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace arenite {

/// Where something was written: a place in the file, or a --set of the command line.
struct Location {
    std::string text; // "scenes/x.toml:14:9" or "--set materials.sand.friction=x"
    int line = 0;     // 0 for --set, so that those come first
    int column = 0;
};

struct SceneEntry;

struct SceneNode {
    enum class Kind { boolean, integer, real, text, array, table, date };

    Kind kind = Kind::table;
    bool boolean = false;
    long long integer = 0;
    double real = 0; // of an integer too
    std::string text;
    std::vector<SceneNode> items;    // array
    std::vector<SceneEntry> entries; // table, in the order of the file
    Location location;

    SceneNode const* find(std::string_view key) const;
    bool is_number() const { return kind == Kind::integer || kind == Kind::real; }
};

struct SceneEntry {
    std::string key;
    Location location; // of the key
    SceneNode node;
};

/// The value as TOML would write it, shortened for messages: 0.7, "sand", [1, 2, 3], a table.
std::string spelling(SceneNode const& node);

/// Parses TOML text; `path` is what the messages call the file. Throws InputError on a syntax error.
SceneNode parse_scene(std::string_view text, std::string const& path);

/// Reads and parses a file. Throws InputError if it cannot be read or is not TOML.
SceneNode load_scene_file(std::string const& path);

/// Applies one "table.key=value" to the tree. The value is any TOML value, or a bare word for a text.
/// An element of an array of tables is named by its index, counted from 0, or by its name:
/// stages.2.time_step, stages.production.time_step. Missing tables and keys are made.
/// Throws InputError if there is no such element or the value is not TOML.
void apply_override(SceneNode& root, std::string const& assignment);

/// What names an element of an array of tables: the key "name", or "wall" for what a stage does with one.
std::string name_of_item(SceneNode const& item);

} // namespace arenite
