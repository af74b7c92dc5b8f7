// SPDX-License-Identifier: MIT
// The state of grains and fluid on the host, as the field output wants it. The only place where field
// output copies from the device.
#pragma once

#include "core/particles.hpp"
#include "fluid/flow.hpp"

#include <vector>

namespace arenite {

/// Owned grains; vectors of three are interleaved (x0, y0, z0, x1, ...).
struct GrainSnapshot {
    Real time = 0;                        // s
    std::vector<Real> position;           // m
    std::vector<Real> diameter;           // m
    std::vector<Real> velocity;           // m/s
    std::vector<Real> spin;               // rad/s
    std::vector<Real> force;              // N
    std::vector<Real> torque;             // N m
    std::vector<Real> fluid_force;        // N; empty without fluid
    std::vector<int> bonds, coordination; // per grain; empty: not known
    std::vector<int> size_class, material;
    std::vector<std::int64_t> id;

    std::size_t count() const { return diameter.size(); }
};

/// What the contacts know about each grain, on the device: [grain]. Unallocated: not known.
struct GrainCounts {
    View1<int> bonds, coordination;
};

GrainSnapshot take_snapshot(Particles const& particles, Real time, GrainCounts const& counts = {});

/// Cells without the halo, i fastest.
struct FluidSnapshot {
    Real time = 0;
    int cells[3] = {0, 0, 0};
    Vec3 lower, spacing;        // m
    std::vector<Real> velocity; // m/s, interstitial, mean of the cell's opposite faces, interleaved
    std::vector<Real> pressure; // Pa
    std::vector<Real> porosity;

    std::size_t count() const { return pressure.size(); }
};

FluidSnapshot take_snapshot(Flow const& flow, Real time);

} // namespace arenite
