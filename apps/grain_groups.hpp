// SPDX-License-Identifier: MIT
// Grains that a scene holds, moves or pulls. Who belongs to a group is settled when the grains are made; what is done to
// them is settled again at the beginning of every stage.
#pragma once

#include "core/particles.hpp"
#include "core/scene.hpp"

#include <map>
#include <set>

namespace arenite {

struct GrainGroups {
    std::vector<std::set<GrainId>> members; // [group of the scene]
    std::set<GrainId> held;                 // by the grains' own file, or all of them
    std::map<GrainId, Vec3> force;          // N, constant, by the grains' own file
};

/// Numbers the grains that have no id yet, and sorts them into the scene's groups by id, class and place.
GrainGroups choose_groups(Scene const& scene, std::vector<Grain>& grains);

/// Motion and applied force of every grain for a stage; a grain that no group moves any more is free and keeps its velocity.
/// Does nothing, and allocates nothing, where no grain is chosen.
void apply_groups(Scene const& scene, std::string const& stage, GrainGroups const& groups, Particles& particles);

} // namespace arenite
