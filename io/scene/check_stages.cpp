// SPDX-License-Identifier: MIT
#include "io/scene/check.hpp"

#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace arenite::scene {
namespace {

/// What the stages before have left: which walls are there and which holes are open.
struct Walls {
    std::map<std::string, bool> present;
    std::map<std::string, std::set<std::string>> open;
};

void check_servo(ServoSettings const& s, std::string const& path, Faults& faults)
{
    if ((s.stress > 0) == (s.force > 0)) faults.add(path, "needs exactly one of stress and force");
    if (faults.given(path + ".axis") && !(norm(s.axis) > 0)) faults.add(path + ".axis", "must not be [0, 0, 0]");
}

void check_holes(WallSettings const& wall, WallAction const& a, std::string const& path, Faults& faults)
{
    for (auto const& [key, list] : {std::pair("open", &a.open), std::pair("close", &a.close)}) {
        if (list->empty()) continue;
        if (wall.shape != WallShape::plane) {
            faults.add(path + "." + key, "only a plane has holes");
            continue;
        }
        for (std::string const& hole : *list)
            check_name(hole, names_of(wall.holes), "hole of wall " + wall.name, path + "." + key, faults);
    }
    for (std::string const& hole : a.open)
        if (std::find(a.close.begin(), a.close.end(), hole) != a.close.end())
            faults.add(path + ".close", fmt::format("\"{}\" is opened in the same stage", hole));
}

void check_motion(WallAction const& a, bool present, std::string const& path, Faults& faults)
{
    bool const moves = a.velocity || a.angular_velocity || a.servo;
    if (moves && !present) faults.add(path, "moves a wall that is not there: add it with present = true");
    if (a.servo && (a.velocity || a.angular_velocity))
        faults.add(path + ".servo", "stands beside a velocity: give one of them");
    if (a.travel && !(a.velocity && norm(*a.velocity) > 0)) faults.add(path + ".travel", "needs a velocity that is not 0");
    if (a.and_back && !a.travel) faults.add(path + ".and_back", "needs travel");
    if (a.ramp_time && !a.velocity && !a.angular_velocity) faults.add(path + ".ramp_time", "needs velocity");
    if (a.servo) check_servo(*a.servo, path + ".servo", faults);
}

void check_actions(Scene const& scene, StageSettings const& s, std::string const& stage_path, Walls& walls, Faults& faults)
{
    for (std::size_t i = 0; i < s.walls.size(); ++i) {
        WallAction const& a = s.walls[i];
        std::string const path = element(stage_path + ".walls", i, a.wall);
        if (a.wall.empty() || !check_name(a.wall, names_of(scene.walls), "wall", path + ".wall", faults)) continue;
        if (a.present) walls.present[a.wall] = *a.present;
        check_motion(a, walls.present[a.wall], path, faults);
        check_holes(*find_wall(scene, a.wall), a, path, faults);
        for (std::string const& hole : a.open) walls.open[a.wall].insert(hole);
        for (std::string const& hole : a.close) walls.open[a.wall].erase(hole);
    }
    if (s.outlet_wall.empty() ||
        !check_name(s.outlet_wall, names_of(scene.walls), "wall", stage_path + ".outlet_wall", faults))
        return;
    if (find_wall(scene, s.outlet_wall)->shape != WallShape::plane)
        faults.add(stage_path + ".outlet_wall", "must be a plane");
    else if (walls.open[s.outlet_wall].empty())
        faults.add(stage_path + ".outlet_wall", "no hole of it is open: [[stages.walls]] with open opens one");
}

void check_end(Scene const& scene, StageSettings const& s, std::string const& stage_path, Walls& walls, Faults& faults)
{
    std::string const path = stage_path + ".end";
    for (auto const& [key, name] :
         {std::pair("stress_wall", &s.end.stress_wall), std::pair("position_wall", &s.end.position_wall)}) {
        if (name->empty() || !check_name(*name, names_of(scene.walls), "wall", path + "." + key, faults)) continue;
        if (!walls.present[*name]) faults.add(path + "." + key, "the wall is not there in this stage");
    }
    bool const travels =
        std::any_of(s.walls.begin(), s.walls.end(), [](WallAction const& a) { return a.travel.has_value(); });
    if (s.end.wall_travel_done && !travels) faults.add(path + ".wall_travel_done", "no wall of this stage has a travel");
    if (s.end.box_stress_tolerance && !(s.box && s.box->holds_stress()))
        faults.add(path + ".box_stress_tolerance", "no axis of this stage's box holds a stress");
}

void check_box(Scene const& scene, StageSettings const& s, std::string const& path, Faults& faults)
{
    BoxSettings const& b = *s.box;
    if (s.kind == StageKind::compression) // its parts choose a carrier
        faults.add(path, "a stage of kind compression strains with its servo's wall: give a box to one of kind dynamics");
    else if (!s.carrier.empty()) faults.add(path, "stands beside carrier: grains ride on one strain, give one of them");
    if (s.fluid) faults.add(path, "stands beside fluid = true: the fluid's cells do not strain with it");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::string const where = path + "." + "xyz"[axis];
        bool const rate = b.strain_rate[axis].has_value(), stress = b.stress[axis].has_value();
        if (rate && stress) faults.add(where, "needs one of strain_rate and stress, not both");
        if ((rate || stress) && !scene.domain.periodic[axis])
            faults.add(where, "the domain is not periodic along this axis");
        if (stress && !(b.max_strain_rate > 0))
            faults.add(path, "missing key max_strain_rate [1/s]: an axis holds a stress");
    }
}

void check_time(Scene const& scene, StageSettings const& s, std::string const& path, Faults& faults)
{
    bool const grains = scene.particles.source != ParticleSource::none;
    bool const sound = !faults.any_faulty({path + ".time_step", path + ".time_step_fraction"});
    if (s.time_step > 0 && s.time_step_fraction > 0)
        faults.add(path + ".time_step_fraction", "stands beside time_step: give one of them");
    if (s.kind == StageKind::generation) return;
    if (!(s.duration > 0) && !faults.any_faulty({path + ".duration"}))
        faults.add(path, "missing key duration [s]: with end conditions, the most that the stage may take");
    if (grains && sound && !(s.time_step > 0) && !(s.time_step_fraction > 0))
        faults.add(path, "missing key time_step [s] or time_step_fraction");
    if (!s.fluid || !scene.fluid || !(s.time_step > 0) || !(scene.fluid->time_step > 0)) return;
    Real const ratio = scene.fluid->time_step / s.time_step;
    constexpr Real rounding = 1e-6; // of 1e-6 / 1e-8 typed as decimals, and much more
    if (ratio < 1 - rounding || std::abs(ratio - std::round(ratio)) > rounding * ratio)
        faults.add(path + ".time_step", fmt::format("fluid.time_step = {} must be a whole number of it, it is {}",
                                                    scene.fluid->time_step, ratio));
}

void check_kind(Scene const& scene, std::size_t index, std::string const& path, Faults& faults)
{
    StageSettings const& s = scene.stages[index];
    for (auto const& [name, material] : s.materials)
        if (int const row = material_row(scene, name);
            row >= 0 && material.density != scene.materials[static_cast<std::size_t>(row)].density)
            faults.add(path + ".materials." + name + ".density", "grains keep the mass that they were made with");
    if (s.kind == StageKind::generation && scene.particles.source != ParticleSource::distribution)
        faults.add(path + ".kind", "generation needs grains from a distribution");
    if (s.kind == StageKind::generation && index > 0) faults.add(path + ".kind", "generation must be the first stage");
    bool const pressed =
        std::any_of(s.walls.begin(), s.walls.end(), [](WallAction const& a) { return a.servo.has_value(); });
    if (s.kind == StageKind::compression && !pressed)
        faults.add(path + ".kind", "compression needs a wall with [stages.walls.servo]");
    if (s.kind == StageKind::compression && scene.particles.source == ParticleSource::none)
        faults.add(path + ".kind", "compression needs grains: there is no table [particles]");
    if (s.target_porosity > 0 && !pressed) faults.add(path + ".target_porosity", "needs a wall with [stages.walls.servo]");
    if (!s.carrier.empty() && check_name(s.carrier, names_of(scene.walls), "wall", path + ".carrier", faults) &&
        find_wall(scene, s.carrier)->shape != WallShape::plane)
        faults.add(path + ".carrier", "must be a plane");
    if (s.fluid && s.kind != StageKind::dynamics) faults.add(path + ".fluid", "only a stage of kind dynamics has fluid");
    if (s.fluid && !scene.fluid) faults.add(path + ".fluid", "there is no table [fluid]");
    if (s.fluid && !s.carrier.empty())
        faults.add(path + ".fluid", "stands beside carrier: the fluid does not feel the strain that grains ride on");
}

} // namespace

void check_stages(Scene const& scene, Faults& faults)
{
    if (scene.stages.empty()) return faults.add("", "missing table [[stages]]: nothing would happen");
    Walls walls;
    for (WallSettings const& wall : scene.walls) walls.present[wall.name] = wall.present;
    bool generated = false;
    for (std::size_t i = 0; i < scene.stages.size(); ++i) {
        StageSettings const& s = scene.stages[i];
        std::string const path = element("stages", i, s.name);
        check_kind(scene, i, path, faults);
        check_time(scene, s, path, faults);
        check_actions(scene, s, path, walls, faults);
        check_end(scene, s, path, walls, faults);
        if (s.box) check_box(scene, s, path + ".box", faults);
        generated = generated || s.kind == StageKind::generation;
    }
    if (scene.particles.source == ParticleSource::distribution && !generated)
        faults.add("particles.source", "grains from a distribution need a first stage of kind = \"generation\"");
}

} // namespace arenite::scene
