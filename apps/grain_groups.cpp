// SPDX-License-Identifier: MIT
#include "apps/grain_groups.hpp"

#include <algorithm>

namespace arenite {
namespace {

bool is_chosen(GrainGroupSettings const& group, Grain const& grain)
{
    auto const holds = [](auto const& list, auto value) { return std::find(list.begin(), list.end(), value) != list.end(); };
    if (holds(group.ids, static_cast<long long>(grain.id)) || holds(group.classes, grain.size_class)) return true;
    if (!group.region) return false;
    for (int axis = 0; axis < 3; ++axis)
        if (grain.position[axis] < group.region->lower[axis] || grain.position[axis] > group.region->upper[axis])
            return false;
    return true;
}

bool acts_in(GrainGroupSettings const& group, std::string const& stage)
{
    return group.stages.empty() || std::find(group.stages.begin(), group.stages.end(), stage) != group.stages.end();
}

/// What the stage does to one grain, on top of what its file says.
void act(Scene const& scene, std::string const& stage, GrainGroups const& groups, Grain& grain)
{
    grain.motion = groups.held.count(grain.id) ? Motion::held : Motion::free;
    auto const own = groups.force.find(grain.id);
    grain.applied_force = own == groups.force.end() ? Vec3{} : own->second;
    for (std::size_t g = 0; g < scene.groups.size(); ++g) {
        GrainGroupSettings const& group = scene.groups[g];
        if (!acts_in(group, stage) || !groups.members[g].count(grain.id)) continue;
        grain.applied_force += group.force;
        if (group.held) grain.motion = Motion::held;
        if (!group.velocity && !group.spin) continue;
        grain.motion = Motion::prescribed;
        grain.velocity = group.velocity.value_or(Vec3{});
        grain.spin = group.spin.value_or(Vec3{});
    }
    if (grain.motion == Motion::held) grain.velocity = grain.spin = {};
}

} // namespace

GrainGroups choose_groups(Scene const& scene, std::vector<Grain>& grains)
{
    GrainGroups groups;
    groups.members.resize(scene.groups.size());
    for (std::size_t i = 0; i < grains.size(); ++i) {
        Grain& grain = grains[i];
        if (grain.id < 0) grain.id = static_cast<GrainId>(i);
        if (scene.particles.held || grain.motion == Motion::held) groups.held.insert(grain.id);
        if (!(grain.applied_force == Vec3{})) groups.force[grain.id] = grain.applied_force;
        for (std::size_t g = 0; g < scene.groups.size(); ++g)
            if (is_chosen(scene.groups[g], grain)) groups.members[g].insert(grain.id);
    }
    return groups;
}

void apply_groups(Scene const& scene, std::string const& stage, GrainGroups const& groups, Particles& particles)
{
    if (scene.groups.empty() && groups.held.empty() && groups.force.empty()) return;
    std::vector<Grain> grains = download(particles);
    auto const velocity = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.velocity);
    auto const spin = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.spin);
    auto const motion = Kokkos::create_mirror_view(particles.motion);
    RecordView::HostMirror const applied("applied_force", particles.count);
    bool any_force = false;
    for (int i = 0; i < particles.count; ++i) {
        act(scene, stage, groups, grains[i]);
        set_vector(velocity, i, grains[i].velocity);
        set_vector(spin, i, grains[i].spin);
        set_vector(applied, i, grains[i].applied_force);
        motion(i) = grains[i].motion;
        any_force = any_force || !(grains[i].applied_force == Vec3{});
    }
    Kokkos::deep_copy(particles.velocity, velocity);
    Kokkos::deep_copy(particles.spin, spin);
    Kokkos::deep_copy(particles.motion, motion);
    particles.applied_force = any_force ? RecordView("applied_force", particles.count) : RecordView();
    if (any_force) Kokkos::deep_copy(particles.applied_force, applied);
}

} // namespace arenite
