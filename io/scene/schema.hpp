// SPDX-License-Identifier: MIT
// The table of keys. Each table of the scene file is described once, as a list of Fields: name, where
// its value is kept, unit, range, one line of text. Reading, range messages, the resolved scene and the
// reference in docs/scene.md all follow from that list. A new key is one line in io/scene/fields_*.cpp.
#pragma once

#include "core/scene.hpp"

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace arenite::scene {

struct Range {
    Real lower = -std::numeric_limits<Real>::infinity(), upper = std::numeric_limits<Real>::infinity();
    bool lower_open = false, upper_open = false;

    bool holds(Real value) const;
    bool bounded() const;
    std::string text() const; // "> 0", "in (-1, 0.5)", "at least 1"
};

inline Range positive() { return {0, std::numeric_limits<Real>::infinity(), true, false}; }
inline Range not_negative() { return {0, std::numeric_limits<Real>::infinity(), false, false}; }
inline Range at_least(Real lower) { return {lower, std::numeric_limits<Real>::infinity(), false, false}; }
inline Range between_open(Real lower, Real upper) { return {lower, upper, true, true}; }
inline Range between(Real lower, Real upper) { return {lower, upper, false, false}; }
inline Range above_up_to(Real lower, Real upper) { return {lower, upper, true, false}; }

struct Field;
using Fields = std::vector<Field>;

/// One word of a closed list.
struct Choice {
    std::vector<std::string> names;
    std::function<int()> get;
    std::function<void(int)> set;
};

/// Words of a closed list, each at most once.
struct WordList {
    std::vector<std::string>* value;
    std::vector<std::string> allowed; // empty: any
};

/// [name]; made only if the scene writes it, where `optional`.
struct SubTable {
    bool optional = false;
    std::function<bool()> present;
    std::function<Fields()> create;  // makes it if need be; the fields point into it
    std::function<Fields()> example; // of one with defaults only, for the documentation
};

/// [[name]]
struct TableList {
    std::function<std::size_t()> size;
    std::function<Fields(std::size_t)> at;
    std::function<Fields()> append;
    std::function<Fields()> example;
    std::string label; // key that names an element in messages and in --set; "" by index
};

/// [name.KEY], KEY of the user's choice.
struct TableMap {
    std::function<std::vector<std::string>()> names;
    std::function<Fields(std::string const&)> create; // or the one that is there
    std::function<Fields()> example;
};

using Target = std::variant<bool*, int*, long long*, unsigned long long*, Real*, std::string*, Vec3*, std::optional<bool>*,
                            std::optional<int>*, std::optional<long long>*, std::optional<Real>*, std::optional<Vec3>*,
                            std::array<int, 3>*, std::array<bool, 3>*, std::array<std::string, 2>*, std::vector<Real>*,
                            std::vector<int>*, std::vector<long long>*, std::vector<Vec3>*, Choice, WordList, SubTable,
                            TableList, TableMap>;

struct Field {
    std::string name;
    Target target;
    std::string unit; // "" where there is none
    std::string text; // what it is
    Range range = {}; // of the number or of each component
    bool required = false;
    std::function<bool()> when = {}; // the key has a meaning only then; keys before this one are already read
    std::string when_text = {};      // the same in words: type = "plane"
    std::string default_text = {};   // what 0 or nothing stands for
};

inline Field required(Field field)
{
    field.required = true;
    return field;
}
inline Field only_when(std::function<bool()> when, std::string text, Field field)
{
    field.when = std::move(when);
    field.when_text = std::move(text);
    return field;
}
inline Field standing_for(std::string text, Field field)
{
    field.default_text = std::move(text);
    return field;
}

template <class Enum> Choice choice(Enum& value, std::vector<std::string> names)
{
    return {std::move(names), [&value] { return static_cast<int>(value); },
            [&value](int index) { value = static_cast<Enum>(index); }};
}

/// A default-made object that lives as long as the program: what documentation points into.
template <class T> T& example_of()
{
    static T value{};
    value = T{};
    return value;
}

template <class T> SubTable table_of(T& value, Fields (*fields)(T&))
{
    return {false, [] { return true; }, [&value, fields] { return fields(value); },
            [fields] { return fields(example_of<T>()); }};
}

template <class T> SubTable optional_table_of(std::optional<T>& value, Fields (*fields)(T&))
{
    return {true, [&value] { return value.has_value(); },
            [&value, fields] {
                if (!value) value.emplace();
                return fields(*value);
            },
            [fields] { return fields(example_of<T>()); }};
}

template <class T> TableList list_of(std::vector<T>& list, Fields (*fields)(T&), std::string label = {})
{
    return {[&list] { return list.size(); }, [&list, fields](std::size_t i) { return fields(list[i]); },
            [&list, fields] { return fields(list.emplace_back()); }, [fields] { return fields(example_of<T>()); },
            std::move(label)};
}

/// True for what is written as a table of its own.
bool is_nested(Field const& field);

/// "a number", "a whole number", "[x, y, z]", ... for messages and the reference.
std::string type_name(Field const& field);

/// The value as TOML, or nothing where an optional one is not set.
std::optional<std::string> toml_value(Field const& field);

/// A text as a TOML string.
std::string quoted(std::string const& text);

// The tables of the scene file.
Fields scene_fields(Scene& scene);
Fields material_fields(MaterialSettings& material);
Fields interaction_fields(InteractionSettings& interaction);
Fields contact_fields(ContactSettings& contact);
Fields coarse_graining_fields(CoarseGrainingSettings& settings);
Fields region_fields(Region& region);
Fields particles_fields(ParticlesSettings& particles);
Fields group_fields(GrainGroupSettings& group);
Fields wall_fields(WallSettings& wall);
Fields fluid_fields(FluidSettings& fluid);
Fields stage_fields(StageSettings& stage, std::vector<MaterialSettings> const& materials);
Fields output_fields(OutputSettings& output);

} // namespace arenite::scene
