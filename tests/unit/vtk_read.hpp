// SPDX-License-Identifier: MIT
// What VTK's own readers find in a file. No Kokkos here (see io/vtk_pieces.hpp).
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace arenite::test {

struct FoundArray {
    std::string type; // "double", "int", "long long", ...
    int components = 0;
    std::vector<double> values;
};

struct FoundFile {
    bool opened = false;
    long points = 0, verts = 0, lines = 0, polys = 0, cells = 0;
    std::vector<double> coordinates;
    std::vector<std::vector<long>> line_points;
    std::map<std::string, FoundArray> point_data, cell_data, field_data;
    std::array<double, 6> bounds{};
};

FoundFile read_poly(std::filesystem::path const& path);
FoundFile read_image(std::filesystem::path const& path);

} // namespace arenite::test
