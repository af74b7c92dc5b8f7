// SPDX-License-Identifier: MIT
// The grains' state: one struct that owns every per-grain View. Rows 0 .. count-1 are owned by this
// rank; rows count .. count+ghosts-1 are copies of other ranks' grains. Rows move when the grains are
// sorted for locality; a grain is known by its id, never by its row.
#pragma once

#include "core/grain.hpp"
#include "core/types.hpp"

#include <vector>

namespace arenite {

struct Particles {
    int count = 0;  // owned grains
    int ghosts = 0; // copies of grains that another rank owns

    RecordView position; // [grain](x, y, z, radius), m
    RecordView velocity; // [grain](vx, vy, vz, mass), m/s and kg
    RecordView spin;     // [grain](wx, wy, wz, moment of inertia), rad/s and kg m2
    RecordView force;    // [grain](Fx, Fy, Fz, -), N: contacts, walls and everything else, at the last force evaluation
    RecordView torque;   // [grain](Tx, Ty, Tz, -), N m
    View1<GrainId> id;   // [grain]
    View1<std::uint8_t> material;   // [grain] row of the material table
    View1<std::int16_t> size_class; // [grain] class of the size distribution that the grain stands for
    View1<Motion> motion;           // [grain]

    RecordView applied_force; // [grain](Fx, Fy, Fz, -), N: constant forces of the scene; empty if it names none
    RecordView fluid_force;   // [grain](Fx, Fy, Fz, -), N: held between fluid steps; empty without fluid
    RecordView
        coasting; // [grain](vx, vy, vz, 1 or 0 unknown), m/s: where drag alone took its velocity in the last fluid step
    RecordView pressure_force; // [grain](Fx, Fy, Fz, -), N: the part of it that is not drag; empty unless a balance is kept

    int rows() const { return count + ghosts; }
};

/// Uploads grains; mass and inertia follow from the diameter and densities[material] [kg/m3].
/// Throws InputError for a diameter that is not positive or an id that occurs twice.
Particles make_particles(std::vector<Grain> const& grains, std::vector<Real> const& densities);

/// The owned grains as they are now, in row order.
std::vector<Grain> download(Particles const& particles);

/// Row of the material table that all owned grains have, or -1 where they differ (or there is none).
int shared_material(Particles const& particles);

/// Puts row order[i] into row i, for every View that is allocated; rows that order leaves out are dropped.
/// order: [grains that stay] rows. Ghosts are dropped: whoever made them makes them anew.
void permute(Particles& particles, View1<int> const& order);

/// The same for particles whose Views nobody shares: those of records take the memory of the one before them, the first that
/// of spare, [at least the grains that stay], which has that of the last on return. Fresh memory is dear: the system clears
/// it, and a GPU waits for it.
void permute(Particles& particles, View1<int> const& order, RecordView& spare);

} // namespace arenite
