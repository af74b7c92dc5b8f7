// SPDX-License-Identifier: MIT
#include "apps/stage_plan.hpp"

#include "apps/given_grains.hpp"
#include "apps/sample.hpp"
#include "core/error.hpp"
#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace arenite {
namespace {

WallAction const* servo_action(StageSettings const& stage)
{
    auto const found =
        std::find_if(stage.walls.begin(), stage.walls.end(), [](auto const& a) { return a.servo.has_value(); });
    return found == stage.walls.end() ? nullptr : &*found;
}

/// Of the grains that the scene will have.
struct GrainSizes {
    Real volume = 0;              // m3
    std::map<int, Real> smallest; // diameter [m] of the smallest grain of each material, by the material's row

    void add(int material, Real diameter, Real count)
    {
        volume += count * sphere_volume(diameter / 2);
        Real& least = smallest.emplace(material, diameter).first->second;
        least = std::min(least, diameter);
    }
};

GrainSizes grain_sizes(Scene const& scene)
{
    GrainSizes sizes;
    if (scene.particles.source == ParticleSource::distribution) {
        for (SizeClass const& c :
             make_size_classes(scene.particles.distribution, scene.coarse_graining, volume_of(generation_region(scene))))
            if (c.count > 0)
                sizes.add(material_row(scene, scene.particles.material), c.diameter, static_cast<Real>(c.count));
    }
    if (has_given_grains(scene))
        for (Grain const& grain : given_grains(scene)) sizes.add(grain.material, grain.diameter, 1);
    return sizes;
}

constexpr Real looser = 0.03; // by which the porosity is above its target where the densifying ends

/// m along the servo's axis that the grains take at a porosity.
Real sample_height(Scene const& scene, GrainSizes const& grains, WallAction const& press, Real porosity)
{
    Real const area = cross_section(scene.domain.upper - scene.domain.lower, normalized(press.servo->axis));
    return grains.volume / (area * (1 - porosity));
}

void let_nothing_adhere(Scene const& scene, StageSettings& stage)
{
    // The stage's entry of a pair takes the place of the scene's.
    for (InteractionSettings const& named : scene.interactions)
        if (std::none_of(stage.interactions.begin(), stage.interactions.end(),
                         [&](auto const& own) { return own.is_between(named.materials[0], named.materials[1]); }))
            stage.interactions.push_back(named);
    stage.contact.normal = stage.wall_contact.normal = NormalLaw::hertz;
    for (InteractionSettings& pair : stage.interactions)
        if (pair.contact) pair.contact->normal = NormalLaw::hertz;
}

/// Bring the servo's wall quickly to where the sample is a little looser than it will be; the grains ride on the
/// homogeneous strain, so that no front of dense grains runs ahead of the wall. No adhesion: loose grains
/// that stick make arches which 1 MPa does not break, and those would depend on the speed.
PlannedStage densify_part(Scene const& scene, GrainSizes const& grains, StageSettings const& stage, WallAction const& press)
{
    constexpr Real dry_porosity = 0.41;
    PlannedStage planned;
    planned.part = CompressionPart::densify;
    planned.porosity = (stage.target_porosity > 0 ? stage.target_porosity : dry_porosity) + looser;
    StageSettings& part = planned.settings = stage;
    part.kind = StageKind::dynamics;
    let_nothing_adhere(scene, part);
    part.form_bonds.reset();
    part.end = {};
    part.end.wall_travel_done = true;
    part.carrier = press.wall;
    part.target_porosity = 0;
    part.local_damping = std::max(stage.local_damping, Real(0.7));
    WallAction& action =
        *std::find_if(part.walls.begin(), part.walls.end(), [&](auto const& a) { return a.wall == press.wall; });
    action.servo.reset();
    Vec3 const axis = normalized(press.servo->axis);
    action.velocity = press.servo->max_speed * 10 * axis;
    // As far as the scene says it; begin_stage has the sample itself.
    auto const wall =
        std::find_if(scene.walls.begin(), scene.walls.end(), [&](auto const& w) { return w.name == press.wall; });
    Vec3 const start = wall->shape == WallShape::plane ? wall->point : wall->base;
    Vec3 const far_end = dot(axis, Vec3{1, 1, 1}) < 0 ? scene.domain.lower : scene.domain.upper;
    action.travel =
        std::max(Real(0), std::fabs(dot(start - far_end, axis)) - sample_height(scene, grains, press, planned.porosity));
    return planned;
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
    part.materials.clear();                       // what was changed to get here goes back
    if (part.form_bonds) part.form_bonds = false; // they are there since the plate pressed
    part.target_porosity = 0;
    part.local_damping = std::max(stage.local_damping, Real(0.7));
    return part;
}

void expand(Scene const& scene, GrainSizes const& grains, int row, StagePlan& plan)
{
    StageSettings const& stage = scene.stages[row];
    auto const add_planned = [&](PlannedStage planned, std::string const& label) {
        planned.label = label;
        planned.scene_stage = row;
        plan.push_back(planned);
    };
    auto const add = [&](StageSettings const& settings, std::string const& label,
                         CompressionPart part = CompressionPart::none) {
        PlannedStage planned;
        planned.part = part;
        planned.settings = settings;
        add_planned(planned, label);
    };
    if (stage.kind != StageKind::compression) return add(stage, stage.name);
    WallAction const* press = servo_action(stage);
    ARENITE_REQUIRE(press, "the reader lets no compression without a servo pass");
    add_planned(densify_part(scene, grains, stage, *press), stage.name + "/densify");
    add(press_part(stage, *press), stage.name + "/press", CompressionPart::press);
    Real const target = stage.target_porosity;
    if (target > 0)
        plan.back().gap =
            sample_height(scene, grains, *press, target + looser) - sample_height(scene, grains, *press, target);
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
            Real const area =
                action.servo->area > 0 ? action.servo->area : cross_section(size, normalized(action.servo->axis));
            stress = std::max(stress, action.servo->stress > 0 ? action.servo->stress : action.servo->force / area);
        }
        if (stage.box)
            for (auto const& target : stage.box->stress) stress = std::max(stress, target.value_or(0));
    }
    return stress;
}

/// Limits of the material whose grains need the shortest step, with the diameter and the mass that are smallest of all.
void settle_limits(Scene const& scene, std::map<int, Real> const& diameters, Real stress, PlannedStage& planned)
{
    std::vector<MaterialSettings> const materials = stage_materials(scene, planned.settings);
    TimeStepLimits& strictest = planned.limits;
    Real smallest = std::numeric_limits<Real>::infinity(), lightest = smallest;
    if (diameters.empty()) return;
    for (auto const& [row, diameter] : diameters) {
        TimeStepLimits const limits = time_step_limits(diameter, materials[row], planned.pair(row, row), stress);
        smallest = std::min(smallest, limits.smallest_diameter);
        lightest = std::min(lightest, limits.smallest_mass);
        for (auto const& [other, unused] : diameters)
            planned.grain_friction = std::max(planned.grain_friction, planned.pair(row, other).friction);
        if (planned.strictest >= 0 && !(limits.critical() < strictest.critical())) continue;
        strictest = limits;
        planned.strictest = row;
    }
    strictest.smallest_diameter = smallest;
    strictest.smallest_mass = lightest;
}

/// Modified JKR bonds what touches when it begins: unless the stage says otherwise, in the first stage in which the pair
/// adheres so. before: for each pair, whether it did in the stage before. Returns whether any pair does now.
bool settle_bonds(std::optional<bool> form_bonds, std::vector<bool>& before, std::vector<PairConstants>& pairs)
{
    before.resize(pairs.size());
    bool any = false;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        bool const modified = pairs[p].surface_energy > 0 && !pairs[p].forms_on_touch;
        pairs[p].bonds_at_start = modified && form_bonds.value_or(!before[p]);
        before[p] = modified;
        any = any || modified;
    }
    return any;
}

} // namespace

StagePlan make_stage_plan(Scene const& scene)
{
    StagePlan plan;
    GrainSizes const grains = grain_sizes(scene);
    for (int row = 0; row < static_cast<int>(scene.stages.size()); ++row) expand(scene, grains, row, plan);
    Real const stress = reference_stress(scene);
    std::vector<bool> bonded, bonded_to_walls;
    for (PlannedStage& planned : plan) {
        planned.materials = static_cast<int>(scene.materials.size());
        planned.pairs = make_pair_constants(scene, planned.settings, planned.settings.contact);
        planned.wall_pairs = make_pair_constants(scene, planned.settings, planned.settings.wall_contact);
        settle_limits(scene, grains.smallest, stress, planned);
        planned.dt = settled_time_step(planned);
        bool const moves = planned.settings.kind == StageKind::dynamics;
        if (moves && !(planned.dt > 0) && !(scene.fluid && planned.settings.fluid))
            throw InputError(fmt::format("{}: stage \"{}\" has no time step: give time_step, or grains to take "
                                         "time_step_fraction of",
                                         scene.path, planned.label));
        if (!(planned.dt > 0) && planned.settings.fluid) planned.dt = scene.fluid->time_step; // a fluid alone
        planned.coupling_interval = settled_coupling_interval(scene, planned);
        planned.keeps_balance = scene.output.energies;
        if (!moves) continue;
        bool const pairs_bond = settle_bonds(planned.settings.form_bonds, bonded, planned.pairs);
        bool const walls_bond = settle_bonds(planned.settings.form_bonds, bonded_to_walls, planned.wall_pairs);
        if (planned.settings.form_bonds.value_or(false) && !pairs_bond && !walls_bond)
            throw InputError(fmt::format("{}: stage \"{}\": form_bonds = true, but no pair of materials adheres under "
                                         "law = \"modified_jkr\" in it",
                                         scene.path, planned.label));
    }
    return plan;
}

} // namespace arenite
