// SPDX-License-Identifier: MIT
// Every key of the scene, one by one, from the reader's own tables: a wrong type, a value out of range, a misspelling and
// an absence are each said once, at their line and column, and all of them at once where they come together.
#include "core/error.hpp"
#include "io/scene/faults.hpp"
#include "io/scene_file.hpp"
#include "io/scene_reader.hpp"
#include "tests/unit/scene_keys.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

using namespace arenite;
using namespace arenite::test;

namespace {

std::vector<std::string> faults_of(std::string const& text)
{
    std::vector<std::string> lines;
    try {
        read_scene_text(text, "t.toml");
    } catch (InputError const& error) {
        std::istringstream all(error.what());
        for (std::string line; std::getline(all, line);) lines.push_back(line);
    }
    return lines;
}

/// The lines that speak of this key: a place, its path, and " = value: " or ": ".
std::vector<std::string> faults_about(std::string const& path, std::string const& text)
{
    std::vector<std::string> about;
    for (std::string const& line : faults_of(text))
        if (line.find(": " + path + " = ") != std::string::npos || line.find(": " + path + ": ") != std::string::npos)
            about.push_back(line);
    return about;
}

/// One fault of the key, and no other that the scene without the key does not have.
void expect_one_fault(SceneKey const& key, std::string const& path, std::string const& text, std::string const& expected)
{
    EXPECT_EQ(faults_about(path, text), std::vector<std::string>{expected}) << "in\n" << text;
    std::vector<std::string> const without = faults_of(key.header);
    for (std::string const& fault : faults_of(text))
        EXPECT_TRUE(fault == expected || std::find(without.begin(), without.end(), fault) != without.end())
            << "follows from the wrong value:\n"
            << fault << "\nin\n"
            << text;
}

/// " = value" as messages show it; tables are not shown.
std::string shown(std::string const& value)
{
    SceneNode const root = parse_scene("v = " + value, "");
    SceneNode const& node = *root.find("v");
    bool const table =
        node.kind == SceneNode::Kind::table || (!node.items.empty() && node.items[0].kind == SceneNode::Kind::table);
    return table ? "" : " = " + spelling(node);
}

std::string unit_of(scene::Field const& field, std::string const& before, std::string const& after)
{
    return field.unit.empty() ? "" : before + field.unit + after;
}

std::string wrong_type_message(scene::Field const& field)
{
    if (auto const* choice = std::get_if<scene::Choice>(&field.target))
        return "must be one of " + scene::join(choice->names);
    if (std::holds_alternative<scene::TableList>(field.target))
        return "must be a list of tables: write [[" + field.name + "]]";
    return "must be " + scene::type_name(field) + unit_of(field, " [", "]");
}

std::string in_brackets(std::string const& heading)
{
    std::size_t const begin = heading.rfind('[') + 1;
    return heading.substr(begin, heading.find(']') - begin);
}

/// On the range's ends, or just inside where they do not belong to it.
std::vector<std::string> values_at_range_ends(SceneKey const& key)
{
    auto const& range = key.field.range;
    std::vector<std::string> values;
    if (std::isfinite(range.lower))
        values.push_back(fmt::format("{}", range.lower_open ? std::nextafter(range.lower, range.lower + 1) : range.lower));
    if (std::isfinite(range.upper))
        values.push_back(fmt::format("{}", range.upper_open ? std::nextafter(range.upper, range.upper - 1) : range.upper));
    return values;
}

} // namespace

TEST(SceneKeys, AreThoseOfTheDocs)
{
    std::set<std::string> documented;
    std::ifstream file(ARENITE_SOURCE_DIR "/docs/scene.md");
    std::string heading;
    bool reference = false;
    for (std::string line; std::getline(file, line);) {
        reference = reference || line == scene_reference_marker;
        if (!reference) continue;
        if (line.rfind("### ", 0) == 0) {
            heading = line.substr(4);
            heading.erase(std::remove(heading.begin(), heading.end(), '`'), heading.end());
            std::string const path = in_brackets(heading);
            // A nested table is a key of the table around it.
            std::string const name = path.size() > 5 && path.ends_with(".NAME") ? path.substr(0, path.size() - 5) : path;
            if (heading == "Top level") continue;
            std::size_t const dot = name.rfind('.');
            documented.insert(dot == std::string::npos ? "Top level " + name : name);
        } else if (line.rfind("| `", 0) == 0) {
            documented.insert(heading + " " + line.substr(3, line.find('`', 3) - 3));
        } else if (line == "The keys of `[materials.NAME]`.") {
            for (std::string const& name : documented)
                if (std::string const materials = "[materials.NAME] "; name.rfind(materials, 0) == 0)
                    documented.insert(heading + " " + name.substr(materials.size()));
        }
    }
    // Nested tables below the top level: by their path, whatever the brackets.
    std::set<std::string> expected;
    for (SceneKey const& key : every_scene_key()) {
        std::string const outer = key.heading.empty() ? "" : in_brackets(key.heading);
        if (scene::is_nested(key.field) && !outer.empty()) expected.insert(outer + "." + key.field.name);
        else expected.insert((key.heading.empty() ? "Top level" : key.heading) + " " + key.field.name);
    }
    EXPECT_GT(expected.size(), 150u);
    EXPECT_EQ(documented, expected);
}

TEST(SceneKeys, AWrongTypeIsSaidOnceAtItsPlace)
{
    for (SceneKey const& key : every_scene_key())
        for (std::string const& value : values_of_wrong_type(key)) {
            WrittenKey const written = write_key(key, key.field.name, value);
            expect_one_fault(key, key.path(), written.text,
                             written.value_place + key.path() + shown(value) + ": " + wrong_type_message(key.field));
        }
}

TEST(SceneKeys, AValueOutOfRangeIsSaidOnceAtItsPlace)
{
    int ranges = 0;
    for (SceneKey const& key : every_scene_key()) {
        auto const expect = [&](std::string const& scalar, std::string const& message) {
            std::string const value = as_value(key, scalar);
            WrittenKey const written = write_key(key, key.field.name, value);
            expect_one_fault(key, key.path(), written.text,
                             written.value_place + key.path() + shown(value) + ": " + message);
        };
        for (std::string const& value : values_out_of_range(key))
            expect(value, "must be " + key.field.range.text() + unit_of(key.field, " ", "")), ++ranges;
        if (!holds_numbers(key)) continue;
        if (!holds_integers(key))
            for (char const* value : {"inf", "-inf", "nan"}) expect(value, "must be finite");
    }
    EXPECT_GT(ranges, 60);
}

TEST(SceneKeys, TheEndsOfARangeAreAsItSays)
{
    for (SceneKey const& key : every_scene_key())
        for (std::string const& value : values_at_range_ends(key)) {
            std::string const text = write_key(key, key.field.name, as_value(key, value)).text;
            for (std::string const& fault : faults_about(key.path(), text))
                EXPECT_EQ(fault.find("must be " + key.field.range.text()), std::string::npos) << fault;
        }
}

TEST(SceneKeys, WholeNumbersThatDoNotFitAreRefused)
{
    std::string const most = "9223372036854775807", least = "-9223372036854775808";
    for (SceneKey const& key : every_scene_key()) {
        if (!holds_integers(key) || key.field.range.bounded()) continue;
        bool const is_unsigned = std::holds_alternative<unsigned long long*>(key.field.target);
        std::string const value = is_unsigned ? "-1" : as_value(key, least);
        bool const fits = std::holds_alternative<std::vector<long long>*>(key.field.target) ||
                          std::holds_alternative<long long*>(key.field.target);
        EXPECT_EQ(faults_about(key.path(), write_key(key, key.field.name, value).text).empty(), fits) << key.path();
    }
}

TEST(SceneKeys, AMisspelledKeyNamesTheRightOne)
{
    for (SceneKey const& key : every_scene_key()) {
        std::string const wrong = misspelled(key.field.name), prefix = key.table.empty() ? "" : key.table + ".";
        ASSERT_EQ(std::count(key.siblings.begin(), key.siblings.end(), wrong), 0) << key.path();
        WrittenKey const written = write_key(key, wrong, "1");
        expect_one_fault(key, prefix + wrong, written.text,
                         written.name_place + prefix + wrong + ": unknown key; did you mean " + key.field.name + "?");
    }
}

TEST(SceneKeys, AMisspelledWordNamesTheRightOne)
{
    int words = 0;
    for (SceneKey const& key : every_scene_key()) {
        auto const expect = [&](std::string const& wrong, std::string const& message) {
            std::string const value = as_value(key, "\"" + wrong + "\"");
            WrittenKey const written = write_key(key, key.field.name, value);
            expect_one_fault(key, key.path(), written.text,
                             written.value_place + key.path() + shown(value) + ": " + message);
            ++words;
        };
        if (auto const* choice = std::get_if<scene::Choice>(&key.field.target))
            for (std::string const& word : choice->names)
                expect(misspelled(word), "must be one of " + scene::join(choice->names) + "; did you mean " + word + "?");
        if (auto const* list = std::get_if<scene::WordList>(&key.field.target))
            for (std::string const& word : list->allowed)
                expect(misspelled(word), fmt::format("\"{}\" is not known; did you mean {}?", misspelled(word), word));
    }
    EXPECT_GT(words, 60);
}

TEST(SceneKeys, AMissingKeyIsSaidAtItsTable)
{
    for (SceneKey const& key : every_scene_key()) {
        if (!key.field.required) continue;
        std::string const missing = fmt::format("missing key {}: {}{}, {}", key.field.name, scene::type_name(key.field),
                                                unit_of(key.field, " [", "]"), key.field.text);
        auto const faults = faults_of(key.header);
        auto const is_it = [&](std::string const& fault) {
            return fault.rfind("t.toml:", 0) == 0 && fault.ends_with(": " + key.table + ": " + missing);
        };
        EXPECT_EQ(std::count_if(faults.begin(), faults.end(), is_it), 1) << key.path() << " in\n" << key.header;
    }
}

TEST(SceneKeys, AllFaultsOfATableComeTogetherInItsOrder)
{
    // Every key of a table wrong, and a misspelling of each beside it; keys that need another one to have a meaning are a
    // table of their own.
    std::vector<SceneKey> keys = every_scene_key();
    std::map<std::string, std::vector<SceneKey>> tables;
    for (SceneKey const& key : keys) tables[key.header].push_back(key);
    std::size_t expected_of_all = 0;
    for (auto const& [header, members] : tables) {
        std::string text = header;
        auto line = std::count(header.begin(), header.end(), '\n');
        std::vector<std::string> expected;
        for (SceneKey const& key : members) {
            std::string const value = values_of_wrong_type(key).back(), wrong = misspelled(key.field.name),
                              prefix = key.table.empty() ? "" : key.table + ".";
            text += fmt::format("{} = {}\n{} = 1\n", key.field.name, value, wrong);
            expected.push_back(fmt::format("t.toml:{}:{}: {}{}: {}", line + 1, key.field.name.size() + 4, key.path(),
                                           shown(value), wrong_type_message(key.field)));
            expected.push_back(
                fmt::format("t.toml:{}:1: {}{}: unknown key; did you mean {}?", line + 2, prefix, wrong, key.field.name));
            line += 2;
        }
        std::vector<std::string> const faults = faults_of(text);
        auto at = faults.begin();
        for (std::string const& fault : expected) {
            at = std::find(at, faults.end(), fault); // in this order
            ASSERT_NE(at, faults.end()) << "not there, or not in the file's order: " << fault << "\nin\n" << text;
        }
        expected_of_all += expected.size();
    }
    EXPECT_EQ(expected_of_all, 2 * keys.size());
}

TEST(SceneKeys, FaultsOfSeveralTablesComeTogetherInTheFilesOrder)
{
    std::vector<std::string> const faults =
        faults_of("titel = 1\n[materials.a]\ndensity = -1\n[domain]\nlower = 0\n"
                  "[[stages]]\nduration = \"x\"\n[fluid]\ncels = 1\n[[walls]]\ntype = 3\n");
    std::vector<int> lines;
    for (std::string const& fault : faults) lines.push_back(std::stoi(fault.substr(std::string("t.toml:").size())));
    EXPECT_TRUE(std::is_sorted(lines.begin(), lines.end()));
    for (int const line : {1, 3, 5, 7, 9, 11}) EXPECT_EQ(std::count(lines.begin(), lines.end(), line), 1) << "line " << line;
}
