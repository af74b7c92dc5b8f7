// SPDX-License-Identifier: MIT
// Periodic simple cubic and face-centred cubic lattices of the paper's sand, every contact loaded alike.
#pragma once

#include "apps/verify/grain_system.hpp"

namespace arenite {

struct Lattice {
    bool face_centred = false;
    NormalLaw law = NormalLaw::hertz;
    Real factor = 1; // k: grains of k 0.23 mm with k times the surface energy
    int cells = 8;   // along an edge; even where the zone corner's mode has to fit

    Real diameter() const { return factor * Real(0.23e-3); }
    /// m, of the cubic cell at a distance between neighbours
    Real edge(Real spacing) const { return face_centred ? spacing * std::sqrt(Real(2)) : spacing; }
    int contacts_per_grain() const { return face_centred ? 6 : 3; } // each counted once
};

/// The lattice with neighbours `spacing` apart, stretched along z; at rest, bonds where its law has them. Grains
/// never slide.
SystemSettings make_lattice(Lattice const& lattice, Real spacing, Real stretch_z = 1);

/// Overlap [m] at which a contact of the lattice carries the force [N], by bisection on the kernels' law.
Real overlap_under(Real force, Lattice const& lattice);

} // namespace arenite
