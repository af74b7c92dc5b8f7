// SPDX-License-Identifier: MIT
// Beds of grains on a lattice in a column of fluid: periodic to the sides, inflow below, a pressure above (or
// closed at both ends).
#pragma once

#include "apps/verify/coupled_case.hpp"

namespace arenite {

struct BedSettings {
    Real porosity = 0.41, superficial = 0; // -, m/s
    Real diameter = 0.23e-3;               // m, of the original grains where they are of one size
    bool paper_sizes = false;              // the paper's sand instead: sizes at random on the sites, shares exact
    bool relaxed = false;                  // pushed apart from the sites until none overlap: a random pack
    Real factor = 1;                       // k; the pack holds 1/k^3 as many grains, k times as large
    std::array<int, 3> cells{2, 2, 10};    // of the bed
    int freeboard = 0;                     // cells above it
    Real grains_per_edge = 6;              // of a cell at k = 1, in each direction
    bool held = true;                      // else free, above a floor of held grains that lies outside the fluid
    bool closed = false;                   // no flow through the ends
    Real push = 0;                         // Pa/m; above 0: periodic along z too, driven by this body force
    Real smoothing_length = 0;             // m; 0: the default of 1.5 cells
    DragLaw drag = DragLaw::di_felice;
    Real grain_density = 2605, density = 998.2, viscosity = 1e-3;
    bool gravity = false;
    Real grain_step = 1; // s
};

struct Bed {
    CoupledCase run;
    BedSettings settings;
    Real pitch = 0;        // m, of the lattice
    Real area = 0;         // m2
    Real height = 0;       // m, of the bed at the start
    Real solid_volume = 0; // m3, without the floor
    int grains = 0;        // without the floor; their ids come first
};

Bed make_bed(BedSettings const& settings);

/// -dp/dz [Pa/m] between the third cells from both ends, the hydrostatic part included.
Real pressure_gradient(Bed const& bed);

/// Superficial velocity [m/s] through the lowest layer of cells.
Real superficial_velocity(Bed const& bed);

/// Fluid's upward force on the grains over their weight.
Real carried_weight(Bed const& bed);

} // namespace arenite
