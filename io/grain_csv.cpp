// SPDX-License-Identifier: MIT
#include "io/grain_csv.hpp"

#include "core/error.hpp"
#include "io/scene/faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <string_view>

namespace arenite {
namespace {

// What is longer is not a CSV of grains, and reading it on would only eat memory.
constexpr std::size_t longest_line = 4096;
constexpr std::size_t most_faults = 20;

std::vector<std::string> const column_names{"x",  "y",  "z",  "diameter", "radius", "vx", "vy",    "vz",   "wx",
                                            "wy", "wz", "fx", "fy",       "fz",     "id", "class", "held", "material"};

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view blanks = " \t\r\"";
    std::size_t const first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string_view> split(std::string_view line)
{
    std::vector<std::string_view> cells;
    for (std::size_t begin = 0;;) {
        std::size_t const comma = line.find(',', begin);
        cells.push_back(trimmed(line.substr(begin, comma - begin)));
        if (comma == std::string_view::npos) return cells;
        begin = comma + 1;
    }
}

class GrainCsvReader {
public:
    GrainCsvReader(std::string const& path, std::vector<std::string> const& materials, int default_material)
        : path_(path), materials_(materials), default_material_(default_material)
    {
    }

    GrainTable read(std::istream& file)
    {
        std::string buffer;
        while (next_line(file, buffer)) {
            std::string_view line = trimmed(buffer);
            constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF"; // before the first line, by spreadsheet programs
            if (line_number_ == 1 && line.substr(0, 3) == byte_order_mark) line = trimmed(line.substr(3));
            if (line.empty() || line[0] == '#') continue;
            if (columns_.empty()) read_header(line);
            else read_grain(line);
            if (faults_.size() >= most_faults) break;
        }
        if (columns_.empty() && faults_.empty()) fault(0, "there is no line that names the columns");
        throw_if_faulty();
        return std::move(table_);
    }

private:
    /// std::getline without its appetite: a file of zeros has one line of any length.
    bool next_line(std::istream& file, std::string& line)
    {
        line.clear();
        ++line_number_;
        for (int c = file.get(); c != std::char_traits<char>::eof(); c = file.get()) {
            if (c == '\n') return true;
            line += static_cast<char>(c);
            if (line.size() <= longest_line) continue;
            fault(0, fmt::format("the line is longer than {} characters", longest_line));
            throw_if_faulty();
        }
        return !line.empty();
    }

    void read_header(std::string_view line)
    {
        for (std::string_view const cell : split(line)) {
            std::string const name(cell.substr(0, 40));
            columns_.push_back(name);
            int const column = static_cast<int>(columns_.size());
            if (std::find(column_names.begin(), column_names.end(), name) == column_names.end())
                fault(column, fmt::format("unknown column \"{}\"{}", name, scene::suggestion(name, column_names)));
            else if (std::find(columns_.begin(), columns_.end() - 1, name) != columns_.end() - 1)
                fault(column, fmt::format("column \"{}\" occurs twice", name));
            if (faults_.size() >= most_faults) throw_if_faulty();
        }
        for (char const* needed : {"x", "y", "z"})
            if (!has(needed)) fault(0, fmt::format("column \"{}\" is missing", needed));
        if (has("diameter") == has("radius")) fault(0, "there must be one of the columns diameter and radius");
        if (!has("material") && default_material_ < 0)
            fault(0, "there is neither a column material nor particles.material in the scene");
        throw_if_faulty(); // without columns every line would be a fault
    }

    bool has(std::string_view name) const { return std::find(columns_.begin(), columns_.end(), name) != columns_.end(); }

    void read_grain(std::string_view line)
    {
        std::vector<std::string_view> const cells = split(line);
        if (cells.size() != columns_.size())
            return fault(0, fmt::format("{} values for {} columns", cells.size(), columns_.size()));
        Grain grain;
        grain.material = default_material_;
        for (std::size_t i = 0; i < cells.size(); ++i) set(grain, static_cast<int>(i), cells[i]);
        if (grain.id >= 0 && !ids_.insert(grain.id).second) fault(0, fmt::format("id {} occurs twice", grain.id));
        table_.grains.push_back(grain);
        table_.lines.push_back(line_number_);
    }

    void set(Grain& grain, int index, std::string_view cell)
    {
        std::string const& name = columns_[static_cast<std::size_t>(index)];
        constexpr std::string_view axes = "xyz";
        if (name.size() == 1) grain.position[static_cast<int>(axes.find(name[0]))] = real(index, cell);
        else if (name.size() == 2 && name != "id") {
            Vec3& vector = name[0] == 'v' ? grain.velocity : name[0] == 'w' ? grain.spin : grain.applied_force;
            vector[static_cast<int>(axes.find(name[1]))] = real(index, cell);
        } else if (name == "diameter" || name == "radius") {
            grain.diameter = real(index, cell) * (name == "radius" ? 2 : 1);
            if (!(grain.diameter > 0)) value_fault(index, cell, "must be > 0 m");
            if (!std::isfinite(grain.diameter)) value_fault(index, cell, "is too large");
        } else if (name == "id") grain.id = integer(index, cell, largest_grain_id);
        else if (name == "class") grain.size_class = static_cast<int>(integer(index, cell, 32767));
        else if (name == "held") grain.motion = flag(index, cell) ? Motion::held : Motion::free;
        else grain.material = material(index, cell);
    }

    Real real(int index, std::string_view cell)
    {
        Real value = 0;
        if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-') cell.remove_prefix(1); // as other programs write it
        auto const [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (cell.empty() || error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
            value_fault(index, cell, "must be a finite number");
            return 1;
        }
        return value;
    }

    GrainId integer(int index, std::string_view cell, GrainId most)
    {
        GrainId value = 0;
        auto const [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        bool const read = !cell.empty() && error == std::errc() && end == cell.data() + cell.size();
        if (read && value >= 0 && value <= most) return value;
        value_fault(index, cell, fmt::format("must be a whole number from 0 to {}", most));
        return -1; // an id of nothing, which occurs nowhere twice
    }

    bool flag(int index, std::string_view cell)
    {
        if (cell == "1" || cell == "true") return true;
        if (cell != "0" && cell != "false") value_fault(index, cell, "must be 0 or 1");
        return false;
    }

    int material(int index, std::string_view cell)
    {
        auto const found = std::find(materials_.begin(), materials_.end(), cell);
        if (found != materials_.end()) return static_cast<int>(found - materials_.begin());
        value_fault(index, cell,
                    "is not a material of the scene" + scene::suggestion(std::string(cell.substr(0, 40)), materials_));
        return 0;
    }

    void value_fault(int index, std::string_view cell, std::string const& message)
    {
        fault(index + 1, fmt::format("{} = {}: {}", columns_[static_cast<std::size_t>(index)], cell.substr(0, 40), message));
    }

    /// column: of the table, counted from 1; 0: the whole line.
    void fault(int column, std::string const& message)
    {
        std::string const where =
            column ? fmt::format("{}:{}:{}", path_, line_number_, column) : fmt::format("{}:{}", path_, line_number_);
        faults_.push_back(scene::printable(where + ": " + message));
    }

    void throw_if_faulty() const
    {
        if (faults_.empty()) return;
        std::string text;
        for (std::string const& line : faults_) text += (text.empty() ? "" : "\n") + line;
        if (faults_.size() >= most_faults)
            text += fmt::format("\n{}: the lines after {} were not looked at", path_, line_number_);
        throw InputError(text);
    }

    std::string path_;
    std::vector<std::string> const& materials_;
    int default_material_;
    int line_number_ = 0;
    std::vector<std::string> columns_;
    std::set<GrainId> ids_;
    std::vector<std::string> faults_;
    GrainTable table_;
};

} // namespace

GrainTable read_grain_csv(std::string const& path, std::vector<std::string> const& materials, int default_material)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) throw InputError(path + ": no such file");
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError(path + ": cannot be read");
    return parse_grain_csv(file, path, materials, default_material);
}

GrainTable parse_grain_csv(std::istream& stream, std::string const& name, std::vector<std::string> const& materials,
                           int default_material)
{
    return GrainCsvReader(name, materials, default_material).read(stream);
}

} // namespace arenite
