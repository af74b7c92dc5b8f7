// SPDX-License-Identifier: MIT
#include "io/history.hpp"

namespace arenite {
namespace {

std::vector<std::string> history_header(HistoryColumns const& columns)
{
    std::vector<std::string> names{"time",           "stage",          "step",       "grains",           "contacts",
                                   "bonds",          "kinetic_energy", "porosity",   "coordination",     "produced_mass",
                                   "produced_count", "lost_mass",      "lost_count", "max_overlap_ratio"};
    for (auto const& wall : columns.walls)
        for (char const* axis : {"x", "y", "z"}) names.push_back("force_" + wall + "_" + axis);
    if (columns.fluid)
        for (char const* name :
             {"pressure_iterations", "pressure_residual", "continuity_error", "courant", "inflow", "outflow"})
            names.emplace_back(name);
    names.insert(names.end(), columns.extra.begin(), columns.extra.end());
    return names;
}

void append_vector(std::vector<Cell>& cells, std::optional<Vec3> const& vector)
{
    for (int axis = 0; axis < 3; ++axis) cells.push_back(vector ? Cell((*vector)[axis]) : Cell());
}

void append_flow(std::vector<Cell>& cells, std::optional<FlowReport> const& flow)
{
    if (!flow) {
        cells.resize(cells.size() + 6);
        return;
    }
    cells.emplace_back(flow->pressure_iterations);
    for (Real const value : {flow->pressure_residual, flow->continuity_error, flow->courant, flow->inflow, flow->outflow})
        cells.emplace_back(value);
}

} // namespace

History::History(std::filesystem::path const& folder, HistoryColumns columns, std::optional<ResumePoint> const& resume)
    : columns_(std::move(columns)), table_(folder / "history.csv", history_header(columns_), rows_until(resume))
{
}

void History::add(HistoryRow const& row)
{
    ARENITE_REQUIRE(row.wall_forces.size() == columns_.walls.size(), "one force for each wall");
    ARENITE_REQUIRE(row.extra.size() == columns_.extra.size(), "one value for each extra column");
    std::vector<Cell> cells{row.time,           row.stage,          row.step,       row.grains,           row.contacts,
                            row.bonds,          row.kinetic_energy, row.porosity,   row.coordination,     row.produced_mass,
                            row.produced_count, row.lost_mass,      row.lost_count, row.max_overlap_ratio};
    for (auto const& force : row.wall_forces) append_vector(cells, force);
    if (columns_.fluid) append_flow(cells, row.flow);
    for (auto const& value : row.extra) cells.emplace_back(value);
    table_.add(cells);
}

ProducedLedger::ProducedLedger(std::filesystem::path const& folder, std::optional<ResumePoint> const& resume)
    : table_(folder / "produced.csv", {"time", "id", "class", "diameter", "k", "mass", "x", "y", "z", "vx", "vy", "vz"},
             resume ? std::optional(TimeSeries::Keep{"time", resume->time, ""}) : std::nullopt)
{
}

void ProducedLedger::add(ProducedGrain const& grain)
{
    std::vector<Cell> cells{grain.time, grain.id, grain.size_class, grain.diameter, grain.coarse_factor, grain.mass};
    append_vector(cells, grain.position);
    append_vector(cells, grain.velocity);
    table_.add(cells);
}

} // namespace arenite
