// SPDX-License-Identifier: MIT
// Triangle meshes from STL files, binary or ASCII.
#pragma once

#include "core/triangle_mesh.hpp"

#include <string>
#include <vector>

namespace arenite {

/// The file's triangles in its own units. Facet normals in the file are not used: the order of the corners says which side
/// is which, as in the format. Throws InputError, with the path and what is wrong where, for a file that cannot be
/// read, is neither form, ends early, names numbers that are none, or has no facet.
std::vector<Triangle> read_stl(std::string const& path);

/// The same from memory; `name` stands for the path in messages.
std::vector<Triangle> parse_stl(std::string const& bytes, std::string const& name);

} // namespace arenite
