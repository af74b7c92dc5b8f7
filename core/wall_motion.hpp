// SPDX-License-Identifier: MIT
// Moving walls: prescribed programs in closed form, and servos that press with a given force.
#pragma once

#include "core/walls.hpp"

namespace arenite {

/// What a wall feels, as measure_walls (kernels/wall_reactions.hpp) sums it.
struct WallReaction {
    Vec3 force;         // N, on the wall
    Vec3 torque;        // N m, about the wall's reference point
    Real stiffness = 0; // N/m: sum of the touching contacts' normal stiffnesses S_n
    Real impedance = 0; // N s/m: sum of sqrt(S_n m) over them
};

/// Speed factor and its integral [s] at a time since the stage began. travel_time: s at full speed that the travel
/// takes; 0: without end.
struct ProgramPoint {
    Real factor = 0, integral = 0;
    bool done = false;
};
ProgramPoint program_at(Real time, Real ramp_time, Real travel_time, bool and_back);

/// s that a program with a travel takes.
Real program_duration(Real ramp_time, Real travel_time, bool and_back);

/// Brings every wall to where it is dt later and the device's poses with it. A wall with a servo keeps the speed that
/// the servo last chose.
void move_walls(Walls& walls, Real dt);

/// Does any wall move or any servo work (is there something to do in move_walls)?
bool any_wall_moves(Walls const& walls);

/// A servo looks at the force every so many steps: one small copy to the host that often. Counted from the stage's
/// beginning, so that a restart keeps the beat.
constexpr int servo_interval = 4;
bool servo_is_due(Walls const& walls);

/// Chooses the servos' speeds from the measured forces; call when servo_is_due. The wall acts as the end of a bar whose
/// mechanical impedance is that of the pack: speed = (target - force) / Z, with Z = sum of sqrt(S_n m) over the
/// wall's contacts, so waves that arrive at the wall leave the pack instead of ringing in it, and the force error
/// decays within about a transit time, without overshoot. Two guards: Z is at least 2 S dt_s, S the sum of the
/// contacts' stiffnesses and dt_s the time between two looks (the discrete loop's own limit), and the speed
/// follows its aim by a quarter per look (dashpots feed the wall's speed straight back into the force).
/// Without contact the wall comes at max_speed.
void update_servos(Walls& walls, std::vector<WallReaction> const& reactions, Real dt);

/// The walls whose surface moves smallest_radius/10 or more in a step, with their speeds, as a message; empty if none. Such
/// a wall could pass a grain between two looks.
std::string tunnelling_walls(Walls const& walls, Real smallest_radius, Real dt);

} // namespace arenite
