// SPDX-License-Identifier: MIT
// Collects what is wrong with a scene, each fault with its place, and throws all of them at once.
#pragma once

#include "io/scene_file.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace arenite::scene {

class Faults {
public:
    /// Remembers where the value of a path ("materials.sand.density") was written and what it says.
    void note(std::string const& path, SceneNode const& node);

    /// True if the scene gives this key (defaults are not given).
    bool given(std::string const& path) const { return places_.count(path) != 0; }

    /// True if one of these keys already has a fault, so that what follows from it need not be said.
    bool any_faulty(std::vector<std::string> const& paths) const;

    /// A fault of the key `path`: at its place, or at that of the innermost table that was written. After
    /// values_are_read() a value that is wrong by itself gets no more: what it would have meant is not known.
    void add(std::string const& path, std::string const& message);

    /// A value that is wrong by itself: type, range, word.
    void add_value(std::string const& path, std::string const& message);
    void values_are_read() { ignored_ = wrong_values_; }

    void add_at(Location const& location, std::string const& message);

    /// A line that already says where it belongs (another file).
    void add_line(std::string const& line);

    /// Throws InputError with every fault, a line each, in the order of the file.
    void throw_if_any() const;

private:
    struct Place {
        Location location;
        std::string value;
    };
    struct Fault {
        int line, column;
        std::string text;
    };
    std::map<std::string, Place> places_;
    std::vector<Fault> faults_;
    std::set<std::string> faulty_, wrong_values_, ignored_; // paths
    std::set<std::string> said_;                            // one mistake seen from two sides is said once
};

/// Control characters as \u0000: a message is one line, and a zero would end it and all that follow.
std::string printable(std::string const& text);

/// The name nearest to `wrong` by edit distance, or "" if none is near.
std::string nearest_name(std::string const& wrong, std::vector<std::string> const& names);

/// "; did you mean density?", or "; one of a, b, c" where nothing is near.
std::string suggestion(std::string const& wrong, std::vector<std::string> const& names);

std::string join(std::vector<std::string> const& names);

} // namespace arenite::scene
