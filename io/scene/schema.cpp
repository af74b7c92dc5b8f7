// SPDX-License-Identifier: MIT
#include "io/scene/schema.hpp"

#include <fmt/format.h>

#include <cmath>

namespace arenite::scene {
namespace {

template <class... Cases> struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases> Overloaded(Cases...) -> Overloaded<Cases...>;

std::string number(Real value) { return fmt::format("{}", value + 0.0); } // -0 would read back as 0
std::string number(long long value) { return fmt::format("{}", value); }
std::string number(int value) { return fmt::format("{}", value); }
std::string word(bool value) { return value ? "true" : "false"; }
std::string vector(Vec3 const& v) { return fmt::format("[{}, {}, {}]", number(v.x), number(v.y), number(v.z)); }

template <class List, class Format> std::string array(List const& list, Format const& format)
{
    std::string text = "[";
    for (auto const& item : list) text += (text.size() > 1 ? ", " : "") + format(item);
    return text + "]";
}

using Value = std::optional<std::string>;

} // namespace

bool Range::holds(Real value) const
{
    return (lower_open ? value > lower : value >= lower) && (upper_open ? value < upper : value <= upper);
}

bool Range::bounded() const { return std::isfinite(lower) || std::isfinite(upper); }

std::string Range::text() const
{
    if (!bounded()) return "";
    if (!std::isfinite(upper)) return fmt::format("{} {}", lower_open ? ">" : ">=", lower);
    if (!std::isfinite(lower)) return fmt::format("{} {}", upper_open ? "<" : "<=", upper);
    return fmt::format("in {}{}, {}{}", lower_open ? "(" : "[", lower, upper, upper_open ? ")" : "]");
}

bool is_nested(Field const& field)
{
    return std::holds_alternative<SubTable>(field.target) || std::holds_alternative<TableList>(field.target) ||
           std::holds_alternative<TableMap>(field.target);
}

std::string type_name(Field const& field)
{
    auto const name = Overloaded{
        [](bool*) { return "true or false"; },
        [](std::optional<bool>*) { return "true or false"; },
        [](int*) { return "a whole number"; },
        [](long long*) { return "a whole number"; },
        [](unsigned long long*) { return "a whole number"; },
        [](std::optional<int>*) { return "a whole number"; },
        [](std::optional<long long>*) { return "a whole number"; },
        [](Real*) { return "a number"; },
        [](std::optional<Real>*) { return "a number"; },
        [](std::string*) { return "a text"; },
        [](Vec3*) { return "a vector [x, y, z]"; },
        [](std::optional<Vec3>*) { return "a vector [x, y, z]"; },
        [](std::array<int, 3>*) { return "three whole numbers"; },
        [](std::array<bool, 3>*) { return "three of true or false"; },
        [](std::array<std::string, 2>*) { return "two texts"; },
        [](std::vector<Real>*) { return "a list of numbers"; },
        [](std::vector<int>*) { return "a list of whole numbers"; },
        [](std::vector<long long>*) { return "a list of whole numbers"; },
        [](std::vector<Vec3>*) { return "a list of vectors [x, y, z]"; },
        [](Choice const&) { return "a choice"; },
        [](WordList const&) { return "a list of texts"; },
        [](SubTable const&) { return "a table"; },
        [](TableList const&) { return "a list of tables"; },
        [](TableMap const&) { return "a table of tables"; },
    };
    return std::visit([&](auto const& target) { return std::string(name(target)); }, field.target);
}

std::optional<std::string> toml_value(Field const& field)
{
    auto const scalar = [](auto const& value) { return number(value); };
    auto const value = Overloaded{
        [](bool* v) -> Value { return word(*v); },
        [](std::optional<bool>* v) -> Value { return *v ? Value(word(**v)) : std::nullopt; },
        [](int* v) -> Value { return number(*v); },
        [](long long* v) -> Value { return number(*v); },
        [](unsigned long long* v) -> Value { return fmt::format("{}", *v); },
        [](std::optional<int>* v) -> Value { return *v ? Value(number(**v)) : std::nullopt; },
        [](std::optional<long long>* v) -> Value { return *v ? Value(number(**v)) : std::nullopt; },
        [](Real* v) -> Value { return number(*v); },
        [](std::optional<Real>* v) -> Value { return *v ? Value(number(**v)) : std::nullopt; },
        [](std::string* v) -> Value { return scene::quoted(*v); },
        [](Vec3* v) -> Value { return vector(*v); },
        [](std::optional<Vec3>* v) -> Value { return *v ? Value(vector(**v)) : std::nullopt; },
        [&](std::array<int, 3>* v) -> Value { return array(*v, scalar); },
        [](std::array<bool, 3>* v) -> Value { return array(*v, word); },
        [](std::array<std::string, 2>* v) -> Value { return array(*v, quoted); },
        [&](std::vector<Real>* v) -> Value { return array(*v, scalar); },
        [&](std::vector<int>* v) -> Value { return array(*v, scalar); },
        [&](std::vector<long long>* v) -> Value { return array(*v, scalar); },
        [](std::vector<Vec3>* v) -> Value { return array(*v, vector); },
        [](Choice const& v) -> Value { return scene::quoted(v.names[static_cast<std::size_t>(v.get())]); },
        [](WordList const& v) -> Value { return array(*v.value, quoted); },
        [](SubTable const&) -> Value { return std::nullopt; },
        [](TableList const&) -> Value { return std::nullopt; },
        [](TableMap const&) -> Value { return std::nullopt; },
    };
    return std::visit(value, field.target);
}

std::string quoted(std::string const& text)
{
    std::string out = "\"";
    for (char const c : text) {
        if (c == '"' || c == '\\') out += {'\\', c};
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else out += c;
    }
    return out + "\"";
}

} // namespace arenite::scene
