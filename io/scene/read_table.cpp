// SPDX-License-Identifier: MIT
// One overload of read() per kind of value. A value that is wrong leaves the default in place, so that
// the rest of the file can still be looked at.
#include "io/scene/read_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arenite::scene {
namespace {

using Kind = SceneNode::Kind;

/// What a value is read with: where it stands and what is known about it.
struct Reading {
    SceneNode const& node;
    Field const& field;
    std::string const& path;
    Faults& faults;

    void wrong_type() const { fault("must be " + type_name(field) + (field.unit.empty() ? "" : " [" + field.unit + "]")); }
    void fault(std::string const& message) const { faults.add_value(path, message); }
};

bool in_range(Reading const& r, Real value)
{
    if (!std::isfinite(value)) {
        r.fault("must be finite");
        return false;
    }
    if (r.field.range.holds(value)) return true;
    std::string const unit = r.field.unit.empty() ? "" : " " + r.field.unit;
    r.fault("must be " + r.field.range.text() + unit);
    return false;
}

// ------------------------------------------------ single values; false: wrong type or out of range

bool read_one(Reading const& r, SceneNode const& node, bool& value)
{
    if (node.kind != Kind::boolean) return r.wrong_type(), false;
    value = node.boolean;
    return true;
}

bool read_one(Reading const& r, SceneNode const& node, Real& value)
{
    if (!node.is_number()) return r.wrong_type(), false;
    if (!in_range(r, node.real)) return false;
    value = node.real;
    return true;
}

template <class Integer> bool read_integer(Reading const& r, SceneNode const& node, Integer& value)
{
    // 27e4 is a whole number too, though TOML calls it a float.
    bool const whole = node.kind == Kind::integer ||
                       (node.kind == Kind::real && node.real == std::floor(node.real) && std::abs(node.real) < 1e15);
    if (!whole) return r.wrong_type(), false;
    long long const read = node.kind == Kind::integer ? node.integer : static_cast<long long>(node.real);
    if (!in_range(r, static_cast<Real>(read))) return false;
    bool const fits = std::is_unsigned_v<Integer> ? read >= 0
                                                  : read >= static_cast<long long>(std::numeric_limits<Integer>::min()) &&
                                                        read <= static_cast<long long>(std::numeric_limits<Integer>::max());
    if (!fits) {
        r.fault(std::is_unsigned_v<Integer> ? "must be >= 0" : read < 0 ? "is too small" : "is too large");
        return false;
    }
    value = static_cast<Integer>(read);
    return true;
}
bool read_one(Reading const& r, SceneNode const& node, int& value) { return read_integer(r, node, value); }
bool read_one(Reading const& r, SceneNode const& node, long long& value) { return read_integer(r, node, value); }
bool read_one(Reading const& r, SceneNode const& node, unsigned long long& value) { return read_integer(r, node, value); }

bool read_one(Reading const& r, SceneNode const& node, std::string& value)
{
    if (node.kind != Kind::text) return r.wrong_type(), false;
    value = node.text;
    return true;
}

bool read_one(Reading const& r, SceneNode const& node, Vec3& value)
{
    if (node.kind != Kind::array || node.items.size() != 3) return r.wrong_type(), false;
    for (int axis = 0; axis < 3; ++axis) {
        SceneNode const& item = node.items[static_cast<std::size_t>(axis)];
        if (!item.is_number()) return r.wrong_type(), false;
        if (!in_range(r, item.real)) return false;
        value[axis] = item.real;
    }
    return true;
}

// ------------------------------------------------ targets

template <class T> void read(Reading const& r, T* target) { read_one(r, r.node, *target); }

template <class T> void read(Reading const& r, std::optional<T>* target)
{
    T value{};
    if (read_one(r, r.node, value)) *target = value;
}

template <class T, std::size_t N> void read(Reading const& r, std::array<T, N>* target)
{
    if (r.node.kind != Kind::array || r.node.items.size() != N) return r.wrong_type();
    for (std::size_t i = 0; i < N; ++i)
        if (!read_one(r, r.node.items[i], (*target)[i])) return;
}

template <class T> void read(Reading const& r, std::vector<T>* target)
{
    if (r.node.kind != Kind::array) return r.wrong_type();
    target->clear();
    for (SceneNode const& item : r.node.items) {
        T value{};
        if (!read_one(r, item, value)) return;
        target->push_back(value);
    }
}

void read(Reading const& r, Choice const& target)
{
    if (r.node.kind == Kind::text)
        for (std::size_t i = 0; i < target.names.size(); ++i)
            if (target.names[i] == r.node.text) return target.set(static_cast<int>(i));
    std::string const nearest = r.node.kind == Kind::text ? nearest_name(r.node.text, target.names) : "";
    r.fault("must be one of " + join(target.names) + (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
}

void read(Reading const& r, WordList const& target)
{
    if (r.node.kind != Kind::array) return r.wrong_type();
    target.value->clear();
    for (SceneNode const& item : r.node.items) {
        if (item.kind != Kind::text) return r.wrong_type();
        auto const is = [&item](std::string const& word) { return word == item.text; };
        if (!target.allowed.empty() && std::none_of(target.allowed.begin(), target.allowed.end(), is))
            r.fault(fmt::format("\"{}\" is not known{}", item.text, suggestion(item.text, target.allowed)));
        else if (std::any_of(target.value->begin(), target.value->end(), is))
            r.fault(fmt::format("\"{}\" occurs twice", item.text));
        else target.value->push_back(item.text);
    }
}

void read(Reading const& r, SubTable const& target)
{
    if (r.node.kind != Kind::table) return r.wrong_type();
    read_table(r.node, target.create(), r.path, r.faults);
}

void read(Reading const& r, TableList const& target)
{
    bool const tables =
        r.node.kind == Kind::array && std::all_of(r.node.items.begin(), r.node.items.end(),
                                                  [](SceneNode const& item) { return item.kind == Kind::table; });
    if (!tables) return r.fault(fmt::format("must be a list of tables: write [[{}]]", r.field.name));
    std::map<std::string, Location> seen;
    for (std::size_t i = 0; i < r.node.items.size(); ++i) {
        SceneNode const& item = r.node.items[i];
        std::string const name = target.label.empty() ? "" : name_of_item(item);
        std::string const path = r.path + "." + (name.empty() ? std::to_string(i) : name);
        if (!name.empty()) {
            auto const [first, is_new] = seen.try_emplace(name, item.location);
            if (!is_new)
                r.faults.add_at(item.location, fmt::format("{}: two entries have {} = \"{}\"; the first is at {}", path,
                                                           target.label, name, first->second.text));
        }
        r.faults.note(path, item);
        read_table(item, target.append(), path, r.faults);
    }
}

void read(Reading const& r, TableMap const& target)
{
    if (r.node.kind != Kind::table) return r.wrong_type();
    for (SceneEntry const& entry : r.node.entries) {
        std::string const path = r.path + "." + entry.key;
        r.faults.note(path, entry.node);
        if (entry.node.kind != Kind::table) r.faults.add_value(path, "must be a table");
        else read_table(entry.node, target.create(entry.key), path, r.faults);
    }
}

/// True for keys whose value says which other keys have a meaning: words, names, flags.
bool decides(Field const& field)
{
    return std::holds_alternative<Choice>(field.target) || std::holds_alternative<std::string*>(field.target) ||
           std::holds_alternative<bool*>(field.target);
}

/// undecided: a key that decides has a wrong value, so nobody knows which others are needed or mean nothing.
void read_field(SceneNode const& table, Field const& field, std::string const& path, std::string const& table_path,
                bool undecided, Faults& faults)
{
    SceneNode const* node = table.find(field.name);
    bool const unclear = undecided && field.when;
    bool const meant = unclear || !field.when || field.when();
    if (!node) {
        if (!meant || unclear || !field.required) return;
        std::string const unit = field.unit.empty() ? "" : " [" + field.unit + "]";
        faults.add(table_path, fmt::format("missing key {}: {}{}, {}", field.name, type_name(field), unit, field.text));
        return;
    }
    faults.note(path, *node);
    if (!meant) return faults.add(path, "has no meaning here: only with " + field.when_text);
    Reading const reading{*node, field, path, faults};
    std::visit([&](auto const& target) { read(reading, target); }, field.target);
}

} // namespace

void read_table(SceneNode const& table, Fields const& fields, std::string const& path, Faults& faults)
{
    std::string const prefix = path.empty() ? "" : path + ".";
    if (path.empty()) faults.note("", table);
    std::vector<std::string> names;
    bool undecided = false;
    for (Field const& field : fields) {
        names.push_back(field.name);
        read_field(table, field, prefix + field.name, path, undecided, faults);
        undecided = undecided || (decides(field) && faults.any_faulty({prefix + field.name}));
    }
    for (SceneEntry const& entry : table.entries) {
        bool known = false;
        for (std::string const& name : names) known = known || name == entry.key;
        if (known) continue;
        faults.add_at(entry.location, fmt::format("{}{}: unknown key{}", prefix, entry.key, suggestion(entry.key, names)));
    }
}

} // namespace arenite::scene
