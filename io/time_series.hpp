// SPDX-License-Identifier: MIT
// CSV tables that grow with the run. The header is set once; a row that a kill cut short is dropped on
// resume, and so is every row past the checkpoint that the run goes on from.
#pragma once

#include "core/real.hpp"
#include "io/atomic_file.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace arenite {

/// Where a resumed run goes on: the step and time of its checkpoint.
struct ResumePoint {
    std::int64_t step = 0;
    Real time = 0;
    std::string stage; // that begins there; "" in the middle of one
};

/// One value as it stands in the file. Nothing is an empty cell; a real has the fewest digits that read
/// back to the same bits.
struct Cell {
    Cell() = default;
    Cell(Real value);
    Cell(std::int64_t value);
    Cell(int value) : Cell(std::int64_t(value)) {}
    Cell(std::string const& value);
    Cell(std::optional<Real> const& value);

    std::string text;
};

class TimeSeries {
public:
    /// Rows whose value in `column` exceeds `value` are dropped, and those of the stage that is begun again.
    struct Keep {
        std::string column;
        Real value = 0;
        std::string stage; // "" where the table has no such column
    };

    /// A new table, or one that goes on with the rows to keep if `keep` is given and the file exists. The file itself
    /// stays as it is until the first flush. Throws InputError if its header is another one.
    TimeSeries(std::filesystem::path path, std::vector<std::string> columns, std::optional<Keep> const& keep = {});

    /// One value for each column.
    void add(std::vector<Cell> const& row);

    /// Everything so far to the disk: before each checkpoint, so that no row is missing after a resume.
    /// Before that a row reaches the file with the first one that is added flush_seconds after the last write.
    void flush();

    std::vector<std::string> const& columns() const { return columns_; }

private:
    static constexpr double flush_seconds = 5;

    void write_pending();

    std::filesystem::path path_;
    std::vector<std::string> columns_;
    AppendedFile file_;
    std::string pending_; // rows that are not in the file yet; at first all of it
    std::chrono::steady_clock::time_point last_write_;
};

/// What a resumed run keeps of a table with the columns step and stage.
std::optional<TimeSeries::Keep> rows_until(std::optional<ResumePoint> const& resume);

/// The cells of one CSV line (quotes undone). Lines with quoted line breaks are not written by us.
std::vector<std::string> split_csv_line(std::string const& line);

} // namespace arenite
