// SPDX-License-Identifier: MIT
// Grains from a CSV file. The first line that is not a comment (#) names the columns, in any order:
// x, y, z and diameter or radius [m] are needed; vx, vy, vz [m/s], wx, wy, wz [rad/s], fx, fy, fz (a
// constant force) [N], material (name), id, class and held (0 or 1) may be there.
#pragma once

#include "core/grain.hpp"

#include <istream>
#include <string>
#include <vector>

namespace arenite {

struct GrainTable {
    std::vector<Grain> grains;
    std::vector<int> lines; // of the file, per grain, for messages
};

/// material is a row of `materials`; grains without a material column get default_material (-1: the
/// column is needed). Throws InputError that lists the faults as FILE:LINE:COLUMN: what.
GrainTable read_grain_csv(std::string const& path, std::vector<std::string> const& materials, int default_material);

/// The same from a stream; `name` stands for the path in messages.
GrainTable parse_grain_csv(std::istream& stream, std::string const& name, std::vector<std::string> const& materials,
                           int default_material);

} // namespace arenite
