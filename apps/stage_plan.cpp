// SPDX-License-Identifier: MIT
#include "apps/stage_plan.hpp"

#include "apps/given_grains.hpp"
#include "core/error.hpp"
#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace arenite {
namespace {

WallAction const* servo_action(StageSettings const& stage)
{
    auto const found =
        std::find_if(stage.walls.begin(), stage.walls.end(), [](auto const& a) { return a.servo.has_value(); });
    return found == stage.walls.end() ? nullptr : &*found;
}

/// Solid volume that the scene's grains will have, m3.
Real solid_volume(Scene const& scene)
{
    Region const region = scene.particles.distribution.region.value_or(Region{scene.domain.lower, scene.domain.upper});
    Vec3 const size = region.upper - region.lower;
    Real volume = 0;
    for (SizeClass const& c :
         make_size_classes(scene.particles.distribution, scene.coarse_graining, size.x * size.y * size.z))
        volume += c.count * 3.14159265358979323846 / 6 * std::pow(c.diameter, 3);
    return volume;
}

constexpr Real looser = 0.03; // by which the porosity is above its target where the densifying ends

/// m along the servo's axis that the scene's grains take at a porosity.
Real sample_height(Scene const& scene, WallAction const& press, Real porosity)
{
    Vec3 const size = scene.domain.upper - scene.domain.lower;
    Real const area = size.x * size.y * size.z / std::fabs(dot(size, normalized(press.servo->axis)));
    return solid_volume(scene) / (area * (1 - porosity));
}

/// Bring the servo's wall quickly to where the sample is a little looser than it will be; the grains ride on the
/// homogeneous strain, so that no front of dense grains runs ahead of the wall. No adhesion: loose grains
/// that stick make arches which 1 MPa does not break, and those would depend on the speed.
StageSettings densify_part(Scene const& scene, StageSettings const& stage, WallAction const& press)
{
    constexpr Real dry_porosity = 0.41;
    Real const porosity = (stage.target_porosity > 0 ? stage.target_porosity : dry_porosity) + looser;
    auto const wall =
        std::find_if(scene.walls.begin(), scene.walls.end(), [&](auto const& w) { return w.name == press.wall; });
    Vec3 const axis = normalized(press.servo->axis);
    Real const height = sample_height(scene, press, porosity);
    Vec3 const start = wall->shape == WallShape::plane ? wall->point : wall->base;
    Vec3 const far_end = dot(axis, Vec3{1, 1, 1}) < 0 ? scene.domain.lower : scene.domain.upper;
    Real const travel = std::fabs(dot(start - far_end, axis)) - height;

    StageSettings part = stage;
    part.kind = StageKind::dynamics;
    part.contact.normal = NormalLaw::hertz;
    part.end = {};
    part.end.wall_travel_done = true;
    part.carrier = press.wall;
    part.target_porosity = 0;
    part.local_damping = std::max(stage.local_damping, Real(0.7));
    WallAction& action =
        *std::find_if(part.walls.begin(), part.walls.end(), [&](auto const& a) { return a.wall == press.wall; });
    action.servo.reset();
    if (travel > 0) {
        action.velocity = press.servo->max_speed * 10 * axis;
        action.travel = travel;
    } else {
        part.duration = 0; // dense enough already
        part.end = {};
    }
    return part;
}

/// Press to the stress under the stage's own law; friction falls until the porosity is right.
StageSettings press_part(StageSettings const& stage, WallAction const& press)
{
    StageSettings part = stage;
    part.kind = StageKind::dynamics;
    part.carrier = press.wall;
    part.local_damping = std::max(stage.local_damping, Real(0.7));
    part.end.kinetic_energy_ratio.reset(); // rest comes in the last part
    part.end.stress_tolerance = std::max(part.end.stress_tolerance, Real(0.1));
    if (stage.target_porosity > 0) { // then the materials' friction comes back and holds the pack: the stress follows
        part.end = {};
        part.end.porosity = stage.target_porosity;
    }
    return part;
}

/// Let it come to rest under the servo with the materials' own friction.
StageSettings relax_part(StageSettings const& stage)
{
    StageSettings part = stage;
    part.kind = StageKind::dynamics;
    part.materials.clear(); // what was changed to get here goes back
    part.target_porosity = 0;
    part.local_damping = std::max(stage.local_damping, Real(0.7));
    return part;
}

void expand(Scene const& scene, int row, StagePlan& plan)
{
    StageSettings const& stage = scene.stages[row];
    auto const add = [&](StageSettings const& settings, std::string const& label,
                         CompressionPart part = CompressionPart::none) {
        PlannedStage planned;
        planned.part = part;
        planned.settings = settings;
        planned.label = label;
        planned.scene_stage = row;
        plan.push_back(planned);
    };
    if (stage.kind != StageKind::compression) return add(stage, stage.name);
    WallAction const* press = servo_action(stage);
    ARENITE_REQUIRE(press, "the reader lets no compression without a servo pass");
    add(densify_part(scene, stage, *press), stage.name + "/densify", CompressionPart::densify);
    add(press_part(stage, *press), stage.name + "/press", CompressionPart::press);
    Real const target = stage.target_porosity;
    if (target > 0) plan.back().gap = sample_height(scene, *press, target + looser) - sample_height(scene, *press, target);
    add(relax_part(stage), stage.name + "/relax", CompressionPart::relax);
}

Real settled_time_step(PlannedStage const& planned)
{
    StageSettings const& stage = planned.settings;
    if (stage.time_step > 0) return stage.time_step;
    return stage.time_step_fraction * planned.limits.critical();
}

int settled_coupling_interval(Scene const& scene, PlannedStage& planned)
{
    if (!planned.settings.fluid || !scene.fluid) return 0;
    if (scene.fluid->coupling_interval > 0) return scene.fluid->coupling_interval;
    Real const ratio = scene.fluid->time_step / planned.dt;
    int const steps = std::max(1, static_cast<int>(std::lround(ratio)));
    // A fraction of the critical step is ours to trim; a step that the scene gives is not.
    if (!(planned.settings.time_step > 0)) {
        int const needed = static_cast<int>(std::ceil(ratio * (1 - Real(1e-12))));
        planned.dt = scene.fluid->time_step / std::max(1, needed);
        return std::max(1, needed);
    }
    if (std::fabs(ratio - steps) > Real(1e-6) * steps)
        throw InputError(
            fmt::format("{}: fluid.time_step = {:g} s is {:.6g} grain steps of stage \"{}\" ({:g} s), it must be a "
                        "whole number",
                        scene.path, scene.fluid->time_step, ratio, planned.label, planned.dt));
    return steps;
}

/// Largest stress [Pa] that a servo of the scene holds: what critical time steps are computed for.
Real reference_stress(Scene const& scene)
{
    Real stress = 0;
    Vec3 const size = scene.domain.upper - scene.domain.lower;
    for (StageSettings const& stage : scene.stages) {
        for (WallAction const& action : stage.walls) {
            if (!action.servo) continue;
            Real const area = action.servo->area > 0
                                  ? action.servo->area
                                  : size.x * size.y * size.z / std::fabs(dot(size, normalized(action.servo->axis)));
            stress = std::max(stress, action.servo->stress > 0 ? action.servo->stress : action.servo->force / area);
        }
        if (stage.box)
            for (auto const& target : stage.box->stress) stress = std::max(stress, target.value_or(0));
    }
    return stress;
}

/// Diameter [m] of the smallest grain of each material that grains of the scene are of, by the material's row.
std::map<int, Real> smallest_diameters(Scene const& scene)
{
    std::map<int, Real> smallest;
    auto const take = [&](int material, Real d) {
        Real& least = smallest.emplace(material, d).first->second;
        least = std::min(least, d);
    };
    if (scene.particles.source == ParticleSource::distribution)
        for (SizeClass const& c : make_size_classes(scene.particles.distribution, scene.coarse_graining, 1))
            if (c.count > 0) take(material_row(scene, scene.particles.material), c.diameter);
    if (has_given_grains(scene))
        for (Grain const& grain : given_grains(scene)) take(grain.material, grain.diameter);
    return smallest;
}

/// Limits of the material whose grains need the shortest step, with the diameter and the mass that are smallest of all.
TimeStepLimits strictest_limits(Scene const& scene, PlannedStage const& planned, std::map<int, Real> const& diameters,
                                Real stress)
{
    std::vector<MaterialSettings> const materials = stage_materials(scene, planned.settings);
    TimeStepLimits strictest;
    Real smallest = std::numeric_limits<Real>::infinity(), lightest = smallest;
    if (diameters.empty()) return strictest;
    for (auto const& [row, diameter] : diameters) {
        PairConstants const& alike = planned.pairs[static_cast<std::size_t>(row) * (materials.size() + 1)];
        TimeStepLimits const limits = time_step_limits(diameter, materials[row], alike, stress);
        smallest = std::min(smallest, limits.smallest_diameter);
        lightest = std::min(lightest, limits.smallest_mass);
        if (!(strictest.smallest_mass > 0) || limits.critical() < strictest.critical()) strictest = limits;
    }
    strictest.smallest_diameter = smallest;
    strictest.smallest_mass = lightest;
    return strictest;
}

bool is_modified(StageSettings const& stage) { return stage.contact.normal == NormalLaw::modified_jkr; }

} // namespace

StagePlan make_stage_plan(Scene const& scene)
{
    StagePlan plan;
    for (int row = 0; row < static_cast<int>(scene.stages.size()); ++row) expand(scene, row, plan);
    Real const stress = reference_stress(scene);
    std::map<int, Real> const diameters = smallest_diameters(scene);
    bool was_modified = false;
    for (PlannedStage& planned : plan) {
        planned.pairs = make_pair_constants(scene, planned.settings, planned.settings.contact);
        planned.wall_pairs = make_pair_constants(scene, planned.settings, planned.settings.wall_contact);
        planned.limits = strictest_limits(scene, planned, diameters, stress);
        planned.dt = settled_time_step(planned);
        bool const moves = planned.settings.kind == StageKind::dynamics;
        if (moves && !(planned.dt > 0) && !(scene.fluid && planned.settings.fluid))
            throw InputError(fmt::format("{}: stage \"{}\" has no time step: give time_step, or grains to take "
                                         "time_step_fraction of",
                                         scene.path, planned.label));
        if (!(planned.dt > 0) && planned.settings.fluid) planned.dt = scene.fluid->time_step; // a fluid alone
        planned.coupling_interval = settled_coupling_interval(scene, planned);
        planned.form_bonds = is_modified(planned.settings) && planned.settings.form_bonds.value_or(!was_modified);
        planned.keeps_balance = scene.output.energies;
        if (moves) was_modified = is_modified(planned.settings);
    }
    return plan;
}

} // namespace arenite
