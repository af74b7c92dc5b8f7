// SPDX-License-Identifier: MIT
#include "tests/unit/scene_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arenite::test {
namespace {

using scene::Field;
using scene::Fields;

/// What has to be written for the key to have a meaning: when_text is made of TOML, or names the key that must be there.
std::string enabling_line(Field const& field)
{
    std::string const& text = field.when_text;
    if (text.empty()) return "";
    if (text == "a source") return "source = \"file\"\n";
    std::string const first = text.substr(0, text.find(" or "));
    return first.find('=') == std::string::npos ? first + " = \"x\"\n" : first + "\n";
}

void collect(Fields const& fields, SceneKey const& at, std::vector<SceneKey>& keys);

void collect_nested(SceneKey const& key, std::vector<SceneKey>& keys)
{
    std::string const name = key.field.name;
    SceneKey inner = key;                                 // its header, table and heading are those of what it holds
    std::size_t const begin = key.heading.rfind('[') + 1; // 0 at the top level
    std::string const outer = key.heading.empty() ? "" : key.heading.substr(begin, key.heading.find(']') - begin) + ".";
    inner.table = key.path();
    if (auto const* table = std::get_if<scene::SubTable>(&key.field.target)) {
        inner.heading = "[" + outer + name + "]";
        inner.header += inner.heading + "\n";
        collect(table->example(), inner, keys);
    } else if (auto const* list = std::get_if<scene::TableList>(&key.field.target)) {
        inner.heading = "[[" + outer + name + "]]";
        inner.header += inner.heading + "\n";
        inner.table += ".0";
        collect(list->example(), inner, keys);
    } else if (auto const* map = std::get_if<scene::TableMap>(&key.field.target)) {
        inner.heading = "[" + outer + name + ".NAME]";
        inner.header += inner.heading + "\n";
        inner.table += ".NAME";
        collect(map->example ? map->example() : map->create("NAME"), inner, keys);
    }
}

void collect(Fields const& fields, SceneKey const& at, std::vector<SceneKey>& keys)
{
    SceneKey key = at;
    key.siblings.clear();
    for (Field const& field : fields) key.siblings.push_back(field.name);
    for (Field const& field : fields) {
        key.field = field;
        key.header = at.header + enabling_line(field);
        keys.push_back(key);
        if (scene::is_nested(field)) collect_nested(key, keys);
    }
}

template <class... T> bool is_one_of(scene::Target const& target) { return (std::holds_alternative<T>(target) || ...); }

} // namespace

std::vector<SceneKey> every_scene_key()
{
    static Scene scene; // the fields point into it
    std::vector<SceneKey> keys;
    collect(scene::scene_fields(scene), {}, keys);
    return keys;
}

WrittenKey write_key(SceneKey const& key, std::string const& name, std::string const& value)
{
    auto const line = 1 + std::count(key.header.begin(), key.header.end(), '\n');
    return {fmt::format("{}{} = {}\n", key.header, name, value), fmt::format("t.toml:{}:1: ", line),
            fmt::format("t.toml:{}:{}: ", line, name.size() + 4)};
}

bool holds_integers(SceneKey const& key)
{
    return is_one_of<int*, long long*, unsigned long long*, std::optional<int>*, std::optional<long long>*,
                     std::array<int, 3>*, std::vector<int>*, std::vector<long long>*>(key.field.target);
}

bool holds_numbers(SceneKey const& key)
{
    return holds_integers(key) ||
           is_one_of<Real*, std::optional<Real>*, Vec3*, std::optional<Vec3>*, std::vector<Real>*, std::vector<Vec3>*>(
               key.field.target);
}

std::string as_value(SceneKey const& key, std::string const& scalar)
{
    scene::Target const& target = key.field.target;
    std::string const three = fmt::format("[{0}, {0}, {0}]", scalar);
    if (is_one_of<Vec3*, std::optional<Vec3>*, std::array<int, 3>*, std::array<bool, 3>*>(target)) return three;
    if (is_one_of<std::vector<Vec3>*>(target)) return "[" + three + "]";
    if (is_one_of<std::array<std::string, 2>*>(target)) return fmt::format("[{0}, {0}]", scalar);
    if (is_one_of<std::vector<Real>*, std::vector<int>*, std::vector<long long>*, scene::WordList>(target))
        return "[" + scalar + "]";
    return scalar;
}

std::vector<std::string> values_of_wrong_type(SceneKey const& key)
{
    scene::Target const& target = key.field.target;
    if (is_one_of<scene::SubTable, scene::TableMap>(target)) return {"1", "\"x\"", "true", "[1, 2]", "1979-05-27"};
    if (is_one_of<scene::TableList>(target)) return {"1", "\"x\"", "[1, 2]", "[[]]", "[{}, 1]"};
    std::vector<std::string> scalars{"1979-05-27", "[[[1]]]"};
    bool const holds_text = is_one_of<std::string*, std::array<std::string, 2>*, scene::Choice, scene::WordList>(target);
    bool const holds_flags = is_one_of<bool*, std::optional<bool>*, std::array<bool, 3>*>(target);
    scalars.push_back(holds_text ? "1" : "\"1\"");
    if (!holds_flags) scalars.push_back("true");
    if (!holds_numbers(key)) scalars.insert(scalars.end(), {"0", "1.5"});
    if (holds_integers(key)) scalars.insert(scalars.end(), {"1.5", "1e300"});
    std::vector<std::string> values{"{ x = 1 }"};
    for (std::string const& scalar : scalars) values.push_back(as_value(key, scalar));
    bool const is_array = as_value(key, "1") != "1";
    values.push_back(is_array ? "1" : "[1]");
    if (as_value(key, "1") == "[1, 1, 1]") values.insert(values.end(), {"[1, 1]", "[1, 1, 1, 1]", "[]"});
    return values;
}

std::vector<std::string> values_out_of_range(SceneKey const& key)
{
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    auto const& range = key.field.range;
    std::vector<std::string> values;
    auto const add = [&](Real bound, bool open, Real towards) {
        Real const beyond = holds_integers(key) ? bound + (towards < 0 ? -1 : 1) : std::nextafter(bound, towards);
        if (std::isfinite(bound)) values.push_back(fmt::format("{}", open ? bound : beyond));
    };
    add(range.lower, range.lower_open, -infinity);
    add(range.upper, range.upper_open, infinity);
    return values;
}

std::string misspelled(std::string const& word)
{
    std::string wrong = word;
    return wrong.insert(word.size() / 2, 1, word[word.size() / 2]);
}

} // namespace arenite::test
