// SPDX-License-Identifier: MIT
#pragma once

#include "io/scene/schema.hpp"

namespace arenite::scene {

/// The tables as TOML with every value that has a meaning, units in comments, nested tables after values.
std::string write_table(Fields const& fields, std::string const& path);

/// Markdown: a section and a table of keys for each table of the scene file.
std::string document_tables();

} // namespace arenite::scene
