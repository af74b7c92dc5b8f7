// SPDX-License-Identifier: MIT
#include "io/scene_file.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace arenite {
namespace {

Location location_of(toml::source_region const& source, std::string const& path)
{
    int const line = static_cast<int>(source.begin.line), column = static_cast<int>(source.begin.column);
    // A table that exists only because a longer key names it has no place of its own.
    if (line == 0) return {path, 1, 1};
    return {fmt::format("{}:{}:{}", path, line, column), line, column};
}

SceneNode convert(toml::node const& from, std::string const& path);

void convert_table(toml::table const& from, std::string const& path, SceneNode& to)
{
    to.kind = SceneNode::Kind::table;
    for (auto const& [key, value] : from)
        to.entries.push_back({std::string(key.str()), location_of(key.source(), path), convert(value, path)});
    // toml++ sorts by key; the file's order is what its author means (materials, messages).
    std::stable_sort(to.entries.begin(), to.entries.end(), [](SceneEntry const& a, SceneEntry const& b) {
        return std::pair(a.location.line, a.location.column) < std::pair(b.location.line, b.location.column);
    });
}

SceneNode convert(toml::node const& from, std::string const& path)
{
    SceneNode to;
    to.location = location_of(from.source(), path);
    using Kind = SceneNode::Kind;
    if (auto const* table = from.as_table()) {
        convert_table(*table, path, to);
    } else if (auto const* array = from.as_array()) {
        to.kind = Kind::array;
        for (toml::node const& item : *array) to.items.push_back(convert(item, path));
    } else if (auto const* text = from.as_string()) {
        to.kind = Kind::text;
        to.text = text->get();
    } else if (auto const* integer = from.as_integer()) {
        to.kind = Kind::integer;
        to.integer = integer->get();
        to.real = static_cast<double>(to.integer);
    } else if (auto const* real = from.as_floating_point()) {
        to.kind = Kind::real;
        to.real = real->get();
    } else if (auto const* boolean = from.as_boolean()) {
        to.kind = Kind::boolean;
        to.boolean = boolean->get();
    } else {
        to.kind = Kind::date;
    }
    return to;
}

SceneNode parse(std::string_view text, std::string const& path)
{
    try {
        return convert(toml::parse(text, path), path);
    } catch (toml::parse_error const& error) {
        throw InputError(
            fmt::format("{}: not valid TOML: {}", location_of(error.source(), path).text, std::string(error.description())));
    }
}

void set_location(SceneNode& node, Location const& location)
{
    node.location = location;
    for (SceneNode& item : node.items) set_location(item, location);
    for (SceneEntry& entry : node.entries) {
        entry.location = location;
        set_location(entry.node, location);
    }
}

/// The value of a --set. What does not look like a TOML value is a text: --set stages.a.contact.law=hertz.
SceneNode parse_override_value(std::string const& value, std::string const& origin)
{
    bool const quoted_or_nested = !value.empty() && std::string_view("[{\"'").find(value[0]) != std::string_view::npos;
    SceneNode node;
    try {
        if (value.find('\n') == std::string::npos) node = parse("value = " + value, origin);
    } catch (InputError const&) {
        if (quoted_or_nested) throw InputError(fmt::format("{}: the value is not valid TOML", origin));
    }
    if (node.entries.size() == 1) {
        node = SceneNode(node.entries[0].node);
    } else {
        node.kind = SceneNode::Kind::text;
        node.text = value;
    }
    set_location(node, {origin, 0, 0});
    return node;
}

std::vector<std::string> split_path(std::string const& path)
{
    std::vector<std::string> parts(1);
    for (char const c : path) {
        if (c == '.') parts.emplace_back();
        else parts.back() += c;
    }
    return parts;
}

bool is_index(std::string const& part)
{
    return !part.empty() && part.size() < 7 && part.find_first_not_of("0123456789") == std::string::npos;
}

SceneNode& item_of(SceneNode& array, std::string const& part, Location const& origin, std::string const& path)
{
    if (is_index(part)) {
        std::size_t const index = std::stoul(part);
        if (index < array.items.size()) return array.items[index];
        if (index == array.items.size()) {
            array.items.emplace_back().location = origin;
            return array.items.back();
        }
    }
    std::string names;
    for (std::size_t i = 0; i < array.items.size(); ++i) {
        std::string const name = name_of_item(array.items[i]);
        if (!name.empty() && name == part) return array.items[i];
        names += fmt::format("{}{}{}", i ? ", " : "", i, name.empty() ? "" : " (" + name + ")");
    }
    throw InputError(fmt::format("{}: {} has no element '{}'; there {}", origin.text, path, part,
                                 names.empty() ? "are none" : "are " + names));
}

SceneNode& entry_of(SceneNode& table, std::string const& part, bool next_is_index, Location const& origin)
{
    for (SceneEntry& entry : table.entries)
        if (entry.key == part) return entry.node;
    SceneNode node;
    node.location = origin;
    if (next_is_index) node.kind = SceneNode::Kind::array;
    table.entries.push_back({part, origin, node});
    return table.entries.back().node;
}

} // namespace

SceneNode const* SceneNode::find(std::string_view key) const
{
    for (SceneEntry const& entry : entries)
        if (entry.key == key) return &entry.node;
    return nullptr;
}

std::string name_of_item(SceneNode const& item)
{
    for (char const* key : {"name", "wall"})
        if (SceneNode const* name = item.find(key); name && name->kind == SceneNode::Kind::text) return name->text;
    return {};
}

std::string spelling(SceneNode const& node)
{
    using Kind = SceneNode::Kind;
    switch (node.kind) {
    case Kind::boolean:
        return node.boolean ? "true" : "false";
    case Kind::integer:
        return fmt::format("{}", node.integer);
    case Kind::real:
        return fmt::format("{}", node.real);
    case Kind::text:
        return fmt::format("\"{}\"", node.text.size() > 60 ? node.text.substr(0, 57) + "..." : node.text);
    case Kind::date:
        return "a date";
    case Kind::table:
        return "a table";
    case Kind::array:
        break;
    }
    constexpr std::size_t shown = 8;
    std::string text = "[";
    for (std::size_t i = 0; i < std::min(shown, node.items.size()); ++i) text += (i ? ", " : "") + spelling(node.items[i]);
    return text + (node.items.size() > shown ? ", ...]" : "]");
}

SceneNode parse_scene(std::string_view text, std::string const& path) { return parse(text, path); }

SceneNode load_scene_file(std::string const& path)
{
    std::error_code unreadable; // a name too long, a folder that may not be looked into
    if (!std::filesystem::is_regular_file(path, unreadable)) throw InputError(fmt::format("{}: no such scene file", path));
    std::ifstream file(path, std::ios::binary);
    std::string const text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (!file) throw InputError(fmt::format("{}: cannot be read", path));
    return parse(text, path);
}

void apply_override(SceneNode& root, std::string const& assignment)
{
    Location const origin{"--set " + assignment, 0, 0};
    std::size_t const equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) throw InputError(origin.text + ": must be table.key=value");
    std::vector<std::string> const parts = split_path(assignment.substr(0, equals));
    SceneNode* node = &root;
    std::string path;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].empty()) throw InputError(origin.text + ": the key has an empty part");
        bool const next_is_index = i + 1 < parts.size() && is_index(parts[i + 1]);
        if (node->kind == SceneNode::Kind::array) node = &item_of(*node, parts[i], origin, path);
        else if (node->kind == SceneNode::Kind::table) node = &entry_of(*node, parts[i], next_is_index, origin);
        else throw InputError(fmt::format("{}: {} = {} is not a table", origin.text, path, spelling(*node)));
        path += (i ? "." : "") + parts[i];
    }
    *node = parse_override_value(assignment.substr(equals + 1), origin.text);
}

} // namespace arenite
