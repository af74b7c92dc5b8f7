// SPDX-License-Identifier: MIT
// The tables of a run's folder as a test looks at them: rows of cells by the names of their columns.
#pragma once

#include "io/time_series.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace arenite::test {

namespace fs = std::filesystem;
using Row = std::map<std::string, std::string>;

inline double number(Row const& row, std::string const& name)
{
    std::string const& cell = row.at(name);
    return cell.empty() ? 0 : std::stod(cell);
}

inline std::vector<Row> read_table(fs::path const& path)
{
    std::vector<Row> rows;
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) return rows;
    std::vector<std::string> const names = split_csv_line(line);
    while (std::getline(file, line)) {
        std::vector<std::string> const cells = split_csv_line(line);
        Row row;
        for (std::size_t n = 0; n < names.size(); ++n) row[names[n]] = cells.at(n);
        rows.push_back(row);
    }
    return rows;
}

/// What went through the balance sheet of a stage until this row: works and losses by size, J.
inline double turnover(Row const& row)
{
    double sum = 0;
    for (auto const& [name, cell] : row)
        if (name.rfind("work_", 0) == 0 || name.rfind("loss_", 0) == 0) sum += std::fabs(number(row, name));
    return sum;
}

} // namespace arenite::test
