// SPDX-License-Identifier: MIT
// The table of keys, written out: with a scene's values as TOML, with defaults as documentation.
#include "io/scene/write.hpp"

#include <fmt/format.h>

#include <cctype>

namespace arenite::scene {
namespace {

bool is_meant(Field const& field) { return !field.when || field.when(); }

std::string toml_key(std::string const& name)
{
    bool bare = !name.empty();
    for (char const c : name) bare = bare && (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-');
    return bare ? name : quoted(name);
}

std::string write_value(Field const& field)
{
    std::optional<std::string> const value = toml_value(field);
    std::string const unit = field.unit.empty() ? "" : "  # " + field.unit;
    if (value) return fmt::format("{} = {}{}\n", field.name, *value, unit);
    // TOML has no word for "not set".
    std::string const default_text = field.default_text.empty() ? "" : ": " + field.default_text;
    return fmt::format("# {} is not set{}\n", field.name, default_text);
}

std::string write_nested(Field const& field, std::string const& path)
{
    std::string text;
    if (auto const* table = std::get_if<SubTable>(&field.target)) {
        if (table->present()) text += fmt::format("\n[{}]\n{}", path, write_table(table->create(), path));
    } else if (auto const* list = std::get_if<TableList>(&field.target)) {
        for (std::size_t i = 0; i < list->size(); ++i)
            text += fmt::format("\n[[{}]]\n{}", path, write_table(list->at(i), path));
    } else if (auto const* map = std::get_if<TableMap>(&field.target)) {
        for (std::string const& name : map->names()) {
            std::string const inner = path + "." + toml_key(name);
            text += fmt::format("\n[{}]\n{}", inner, write_table(map->create(name), inner));
        }
    }
    return text;
}

// ------------------------------------------------ documentation

std::string cell(std::string const& text)
{
    std::string out;
    for (char const c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
    return out;
}

std::string default_of(Field const& field)
{
    if (field.required) return "required";
    if (!field.default_text.empty()) return field.default_text;
    std::optional<std::string> const value = toml_value(field);
    return value ? "`" + *value + "`" : "not set";
}

std::string allowed_of(Field const& field)
{
    auto const* choice = std::get_if<Choice>(&field.target);
    if (!choice) {
        std::string type = type_name(field);
        return type + (field.range.bounded() ? ", " + field.range.text() : "");
    }
    std::string text;
    for (std::string const& name : choice->names) text += (text.empty() ? "`\"" : ", `\"") + name + "\"`";
    return text;
}

std::string document_row(Field const& field)
{
    std::string const when = field.when_text.empty() ? "" : " (with " + field.when_text + ")";
    return fmt::format("| `{}` | {} | {} | {} | {}{} |\n", field.name, cell(allowed_of(field)),
                       field.unit.empty() ? "" : field.unit, cell(default_of(field)), cell(field.text), cell(when));
}

std::string document(Fields const& fields, std::string const& path);

std::string document_nested(Field const& field, std::string const& outer)
{
    std::string const path = outer.empty() ? field.name : outer + "." + field.name;
    std::string heading = "[" + path + "]", body;
    if (auto const* table = std::get_if<SubTable>(&field.target)) {
        body = document(table->example(), path);
    } else if (auto const* list = std::get_if<TableList>(&field.target)) {
        heading = "[[" + path + "]]";
        body = document(list->example(), path);
    } else if (auto const* map = std::get_if<TableMap>(&field.target)) {
        heading = "[" + path + ".NAME]";
        body = map->example ? document(map->example(), path + ".NAME") : "The keys of `[materials.NAME]`.\n";
    }
    std::string const needed =
        field.required ? " Required" + (field.when_text.empty() ? "." : " with " + field.when_text + ".") : "";
    std::string const fallback = field.default_text.empty() ? "" : " Unless written: " + field.default_text + ".";
    std::string sentence = field.text;
    sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
    return fmt::format("\n### `{}`\n\n{}.{}{}\n\n{}", heading, sentence, needed, fallback, body);
}

std::string document(Fields const& fields, std::string const& path)
{
    std::string rows, nested;
    for (Field const& field : fields)
        (is_nested(field) ? nested : rows) += is_nested(field) ? document_nested(field, path) : document_row(field);
    if (!rows.empty()) rows = "| key | value | unit | default | meaning |\n| --- | --- | --- | --- | --- |\n" + rows;
    return rows + nested;
}

} // namespace

std::string write_table(Fields const& fields, std::string const& path)
{
    std::string text;
    for (Field const& field : fields)
        if (is_meant(field) && !is_nested(field)) text += write_value(field);
    for (Field const& field : fields)
        if (is_meant(field) && is_nested(field))
            text += write_nested(field, path.empty() ? field.name : path + "." + field.name);
    return text;
}

std::string document_tables()
{
    Scene scene;
    return "### Top level\n\n" + document(scene_fields(scene), "");
}

} // namespace arenite::scene
