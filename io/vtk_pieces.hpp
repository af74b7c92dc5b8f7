// SPDX-License-Identifier: MIT
// What a VTK XML file holds, without VTK: points with cells, or a grid of cells, and named arrays. VTK's
// writers turn it into a compressed file; where VTK is left out our own plain writer does, uncompressed.
// No Kokkos here: nvcc does not digest VTK's headers, and Kokkos wants nvcc, so what includes both cannot
// be compiled for CUDA.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace arenite {

struct DataArray {
    std::string name;
    int components = 1;
    std::variant<std::vector<double>, std::vector<int>, std::vector<std::int64_t>> values;
};

enum class CellKind { vertices, lines, polygons };

/// One kind of cells over points (.vtp).
struct PolyPiece {
    double time = 0;
    std::vector<double> points; // interleaved, m
    CellKind kind = CellKind::vertices;
    std::vector<std::int64_t> connectivity; // point numbers of each cell in turn
    std::vector<std::int64_t> offsets;      // [cell] end of the cell in connectivity
    std::vector<DataArray> point_data, cell_data;

    std::size_t point_count() const { return points.size() / 3; }
};

/// A uniform grid with values at cells (.vti), i fastest.
struct ImagePiece {
    double time = 0;
    std::array<int, 3> cells{};
    std::array<double, 3> lower{}, spacing{1, 1, 1}; // m
    std::vector<DataArray> cell_data;
};

/// The bytes of the file: by VTK where it is there, else as encode_plain does.
std::string encode(PolyPiece const& piece);
std::string encode(ImagePiece const& piece);

/// Appended raw data, not compressed, without VTK.
std::string encode_plain(PolyPiece const& piece);
std::string encode_plain(ImagePiece const& piece);

} // namespace arenite
