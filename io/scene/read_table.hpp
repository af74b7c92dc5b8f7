// SPDX-License-Identifier: MIT
#pragma once

#include "io/scene/faults.hpp"
#include "io/scene/schema.hpp"

namespace arenite::scene {

/// Fills what `fields` point to from a table of the file. Wrong types, values out of range, unknown and
/// missing keys go to `faults`; every path that the table gives is noted there. path: "" for the whole file.
void read_table(SceneNode const& table, Fields const& fields, std::string const& path, Faults& faults);

} // namespace arenite::scene
