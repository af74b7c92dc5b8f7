// SPDX-License-Identifier: MIT
#include "io/scene/faults.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace arenite::scene {
namespace {

std::size_t edit_distance(std::string const& a, std::string const& b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            std::size_t const change = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
        }
    }
    return row.back();
}

} // namespace

void Faults::note(std::string const& path, SceneNode const& node)
{
    bool const scalar =
        node.kind != SceneNode::Kind::table && (node.items.empty() || node.items[0].kind != SceneNode::Kind::table);
    places_[path] = {node.location, scalar ? spelling(node) : ""};
}

bool Faults::any_faulty(std::vector<std::string> const& paths) const
{
    return std::any_of(paths.begin(), paths.end(), [this](std::string const& path) { return faulty_.count(path) != 0; });
}

void Faults::add_value(std::string const& path, std::string const& message)
{
    add(path, message);
    wrong_values_.insert(path);
}

void Faults::add(std::string const& path, std::string const& message)
{
    if (ignored_.count(path)) return;
    faulty_.insert(path);
    std::string enclosing = path;
    auto place = places_.find(enclosing);
    while (place == places_.end() && !enclosing.empty()) {
        std::size_t const dot = enclosing.rfind('.');
        enclosing = dot == std::string::npos ? "" : enclosing.substr(0, dot);
        place = places_.find(enclosing);
    }
    Location const location = place == places_.end() ? Location{} : place->second.location;
    std::string const value =
        enclosing == path && !path.empty() && !place->second.value.empty() ? " = " + place->second.value : "";
    add_at(location, path.empty() ? message : fmt::format("{}{}: {}", path, value, message));
}

void Faults::add_at(Location const& location, std::string const& message)
{
    std::string const text = printable(fmt::format("{}: {}", location.text, message));
    if (said_.insert(text).second) faults_.push_back({location.line, location.column, text});
}

void Faults::add_line(std::string const& line)
{
    if (said_.insert(line).second) faults_.push_back({std::numeric_limits<int>::max(), 0, line});
}

void Faults::throw_if_any() const
{
    if (faults_.empty()) return;
    std::vector<Fault> sorted = faults_;
    std::stable_sort(sorted.begin(), sorted.end(), [](Fault const& a, Fault const& b) {
        return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    std::string text;
    for (Fault const& fault : sorted) text += (text.empty() ? "" : "\n") + fault.text;
    throw InputError(text);
}

std::string printable(std::string const& text)
{
    std::string shown;
    for (char const c : text) {
        auto const byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7f) shown += fmt::format("\\u{:04x}", byte);
        else shown += c;
    }
    return shown;
}

std::string nearest_name(std::string const& wrong, std::vector<std::string> const& names)
{
    std::string nearest;
    std::size_t least = std::max<std::size_t>(2, wrong.size() / 2); // farther is another word, not a slip
    for (std::string const& name : names) {
        std::size_t const longer = std::max(wrong.size(), name.size()), shorter = std::min(wrong.size(), name.size());
        if (longer - shorter > least) continue; // so many letters at least are wrong
        std::size_t const distance = edit_distance(wrong, name);
        if (distance > least || (distance == least && !nearest.empty())) continue;
        least = distance;
        nearest = name;
    }
    return nearest;
}

std::string join(std::vector<std::string> const& names)
{
    std::string text;
    for (std::string const& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

std::string suggestion(std::string const& wrong, std::vector<std::string> const& names)
{
    std::string const nearest = nearest_name(wrong, names);
    if (!nearest.empty()) return "; did you mean " + nearest + "?";
    return names.empty() ? "; there is none" : "; there is " + join(names);
}

} // namespace arenite::scene
