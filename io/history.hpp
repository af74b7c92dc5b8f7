// SPDX-License-Identifier: MIT
// history.csv (one row an interval) and produced.csv (one row for each grain that left).
//
// The columns follow from the scene alone, never from the stage, so that every row of a run has the same
// ones: three for the force on each wall of the scene, the fluid's only if the scene has a fluid, then
// whatever the driver adds (energy shares, probes). A cell without a value in a stage is empty.
#pragma once

#include "core/vec3.hpp"
#include "fluid/flow.hpp"
#include "io/time_series.hpp"

namespace arenite {

struct HistoryRow {
    Real time = 0;
    std::string stage;
    std::int64_t step = 0;
    std::int64_t grains = 0, contacts = 0, bonds = 0;
    Real kinetic_energy = 0;                      // J, translation and rotation
    std::optional<Real> porosity;                 // of the sample
    std::optional<Real> coordination;             // contacts per grain
    std::vector<std::optional<Vec3>> wall_forces; // N, in the order of the names; none: not there
    Real produced_mass = 0;                       // kg since the start
    std::int64_t produced_count = 0;
    Real lost_mass = 0; // kg since the start, that left the domain other than through an outlet
    std::int64_t lost_count = 0;
    Real max_overlap_ratio = 0; // overlap / radius
    std::optional<FlowReport> flow;
    std::vector<std::optional<Real>> extra; // in the order of the extra columns
};

struct HistoryColumns {
    std::vector<std::string> walls;
    bool fluid = false;
    std::vector<std::string> extra;
};

class History {
public:
    History(std::filesystem::path const& folder, HistoryColumns columns, std::optional<ResumePoint> const& resume = {});
    void add(HistoryRow const& row);
    void flush() { table_.flush(); }

private:
    HistoryColumns columns_;
    TimeSeries table_;
};

/// A grain at the moment when it left.
struct ProducedGrain {
    Real time = 0;
    GrainId id = 0;
    int size_class = 0;
    Real diameter = 0;      // m, as simulated
    Real coarse_factor = 1; // k: the original grains have diameter / k
    Real mass = 0;          // kg
    Vec3 position, velocity;
};

class ProducedLedger {
public:
    explicit ProducedLedger(std::filesystem::path const& folder, std::optional<ResumePoint> const& resume = {});
    void add(ProducedGrain const& grain);
    void flush() { table_.flush(); }

private:
    TimeSeries table_;
};

} // namespace arenite
