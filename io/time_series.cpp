// SPDX-License-Identifier: MIT
#include "io/time_series.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace arenite {
namespace {

std::string quoted(std::string text)
{
    std::replace(text.begin(), text.end(), '\n', ' ');
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::string result = "\"";
    for (char const c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + '"';
}

std::string header_of(std::vector<std::string> const& columns)
{
    std::vector<std::string> names;
    for (auto const& column : columns) names.push_back(quoted(column));
    return fmt::format("{}\n", fmt::join(names, ","));
}

std::size_t column_of(std::vector<std::string> const& columns, std::string const& name)
{
    auto const found = std::find(columns.begin(), columns.end(), name);
    ARENITE_REQUIRE(found != columns.end(), "no column " + name);
    return static_cast<std::size_t>(found - columns.begin());
}

Real number_in(std::string const& line, std::size_t column, std::filesystem::path const& path)
{
    auto const cells = split_csv_line(line);
    Real value = 0;
    if (column < cells.size()) {
        auto const& cell = cells[column];
        auto const end = cell.data() + cell.size();
        if (auto const [stop, error] = std::from_chars(cell.data(), end, value); error == std::errc() && stop == end)
            return value;
    }
    throw InputError(fmt::format("{}: cannot go on with this file: no number in column {} of the row '{}'", path.string(),
                                 column + 1, line));
}

/// The part of an earlier run's file that a resumed run goes on from.
std::string kept_rows(std::filesystem::path const& path, std::vector<std::string> const& columns,
                      TimeSeries::Keep const& keep)
{
    std::string const content = read_file(path), header = header_of(columns);
    if (content.compare(0, header.size(), header) != 0)
        throw InputError(
            fmt::format("{}: cannot go on with this file: its columns are not those of this scene\n  expected: {}"
                        "  found:    {}",
                        path.string(), header, content.substr(0, content.find('\n'))));
    std::size_t const column = column_of(columns, keep.column), stage = keep.stage.empty() ? 0 : column_of(columns, "stage");
    std::string kept = header;
    std::size_t begin = header.size();
    for (std::size_t end = 0; (end = content.find('\n', begin)) != std::string::npos; begin = end + 1) {
        std::string const line = content.substr(begin, end - begin);
        if (number_in(line, column, path) > keep.value) continue;
        if (!keep.stage.empty() && split_csv_line(line).at(stage) == keep.stage) continue;
        kept += line + '\n';
    }
    return kept; // what follows the last line break was cut short by a kill
}

} // namespace

Cell::Cell(Real value) : text(fmt::format("{}", value)) {}
Cell::Cell(std::int64_t value) : text(fmt::format("{}", value)) {}
Cell::Cell(std::string const& value) : text(quoted(value)) {}
Cell::Cell(std::optional<Real> const& value)
{
    if (value) text = fmt::format("{}", *value);
}

std::vector<std::string> split_csv_line(std::string const& line)
{
    std::vector<std::string> cells(1);
    bool inside = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        bool const quote = line[i] == '"';
        if (quote && inside && i + 1 < line.size() && line[i + 1] == '"') cells.back() += line[i++];
        else if (quote) inside = !inside;
        else if (line[i] == ',' && !inside) cells.emplace_back();
        else cells.back() += line[i];
    }
    return cells;
}

std::optional<TimeSeries::Keep> rows_until(std::optional<ResumePoint> const& resume)
{
    if (!resume) return {};
    return TimeSeries::Keep{"step", static_cast<Real>(resume->step), resume->stage};
}

TimeSeries::TimeSeries(std::filesystem::path path, std::vector<std::string> columns, std::optional<Keep> const& keep)
    : path_(std::move(path)), columns_(std::move(columns)), last_write_(std::chrono::steady_clock::now())
{
    pending_ = keep && std::filesystem::exists(path_) ? kept_rows(path_, columns_, *keep) : header_of(columns_);
}

void TimeSeries::add(std::vector<Cell> const& row)
{
    ARENITE_REQUIRE(row.size() == columns_.size(),
                    fmt::format("{}: {} cells for {} columns", path_.string(), row.size(), columns_.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (i > 0) pending_ += ',';
        pending_ += row[i].text;
    }
    pending_ += '\n';
    if (std::chrono::steady_clock::now() - last_write_ > std::chrono::duration<double>(flush_seconds)) write_pending();
}

void TimeSeries::write_pending()
{
    if (file_.is_open()) {
        file_.append(pending_);
    } else {
        write_file_atomically(path_, pending_);
        file_ = AppendedFile(path_);
    }
    pending_.clear();
    last_write_ = std::chrono::steady_clock::now();
}

void TimeSeries::flush()
{
    write_pending();
    file_.sync();
}

} // namespace arenite
