// SPDX-License-Identifier: MIT
#include "io/scene/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace arenite::scene {
namespace {

/// JKR contacts live down to S, bonds of modified JKR down to C, unless the scene says otherwise.
void complete_contact(ContactSettings& contact, std::string const& path, Faults const& faults)
{
    if (faults.given(path + ".break_point")) return;
    contact.break_point = contact.normal == NormalLaw::jkr ? BreakPoint::S : BreakPoint::C;
}

void complete_interaction(InteractionSettings& entry, InteractionSettings const* scenes)
{
    if (!scenes) return;
    if (!entry.restitution) entry.restitution = scenes->restitution;
    if (!entry.friction) entry.friction = scenes->friction;
    if (!entry.surface_energy) entry.surface_energy = scenes->surface_energy;
    if (!entry.contact) entry.contact = scenes->contact;
}

void complete_stage(StageSettings& stage, std::string const& path, Scene const& scene, Faults const& faults)
{
    complete_contact(stage.contact, path + ".contact", faults);
    complete_contact(stage.wall_contact, path + ".wall_contact", faults);
    for (std::size_t i = 0; i < stage.interactions.size(); ++i) {
        InteractionSettings& entry = stage.interactions[i];
        if (entry.contact) complete_contact(*entry.contact, element(path + ".interactions", i) + ".contact", faults);
        complete_interaction(entry, find_interaction(scene.interactions, entry.materials[0], entry.materials[1]));
    }
}

/// Share of a normal distribution below z standard deviations.
Real normal_share(Real z) { return Real(0.5) * std::erfc(-z / std::sqrt(Real(2))); }

/// Classes of equal width in ln(d), each stood for by the middle of it.
void make_lognormal_classes(DistributionSettings& d)
{
    LognormalSettings const l = *d.lognormal;
    Real const low = std::log(l.minimum), width = (std::log(l.maximum) - low) / l.classes;
    auto const below = [&](Real log_diameter) { return normal_share((log_diameter - std::log(l.median)) / l.sigma); };
    Real const whole = below(low + l.classes * width) - below(low);
    for (int i = 0; i < l.classes; ++i) {
        d.diameters.push_back(std::exp(low + (i + Real(0.5)) * width));
        d.fractions.push_back((below(low + (i + 1) * width) - below(low + i * width)) / whole);
    }
}

void complete_distribution(DistributionSettings& d, Faults& faults)
{
    if (!d.lognormal) return;
    std::string const path = "particles.distribution.lognormal";
    if (!d.diameters.empty() || !d.fractions.empty())
        faults.add(path, "stands beside diameters or fractions: give one of them");
    else if (!(d.lognormal->minimum < d.lognormal->maximum)) faults.add(path + ".minimum", "must be below maximum");
    else if (d.lognormal->median > 0 && d.lognormal->sigma > 0 && d.lognormal->minimum > 0) make_lognormal_classes(d);
    Real sum = 0;
    for (Real const fraction : d.fractions) sum += fraction;
    if (!std::isfinite(sum)) faults.add(path, "has no mass between minimum and maximum");
    d.lognormal.reset();
}

} // namespace

void complete(Scene& scene, Faults& faults)
{
    for (std::size_t i = 0; i < scene.interactions.size(); ++i)
        if (scene.interactions[i].contact)
            complete_contact(*scene.interactions[i].contact, element("interactions", i) + ".contact", faults);
    for (std::size_t i = 0; i < scene.stages.size(); ++i)
        complete_stage(scene.stages[i], element("stages", i, scene.stages[i].name), scene, faults);
    complete_distribution(scene.particles.distribution, faults);
}

void check(Scene const& scene, Faults& faults)
{
    check_region({scene.domain.lower, scene.domain.upper}, "domain", faults);
    std::vector<int> const grain_materials = check_grains(scene, faults);
    check_materials(scene, grain_materials, faults);
    check_walls(scene, faults);
    check_wall_overlaps(scene, faults);
    check_fluid(scene, faults);
    check_stages(scene, faults);
    check_output(scene, faults);
}

void check_region(Region const& region, std::string const& path, Faults& faults)
{
    std::string const lower = path + ".lower", upper = path + ".upper";
    if (!faults.given(lower) || !faults.given(upper) || faults.any_faulty({lower, upper})) return;
    for (int axis = 0; axis < 3; ++axis)
        if (!(region.lower[axis] < region.upper[axis]))
            return faults.add(path + ".upper", fmt::format("must be above lower along {}", "xyz"[axis]));
}

std::string element(std::string const& list, std::size_t i, std::string const& name)
{
    return list + "." + (name.empty() ? std::to_string(i) : name);
}

bool check_name(std::string const& name, std::vector<std::string> const& names, std::string const& what,
                std::string const& path, Faults& faults)
{
    if (std::find(names.begin(), names.end(), name) != names.end()) return true;
    faults.add(path, fmt::format("there is no {} \"{}\"{}", what, name, suggestion(name, names)));
    return false;
}

bool is_file(std::string const& path)
{
    std::error_code error;
    return path.find('\0') == std::string::npos && std::filesystem::is_regular_file(path, error);
}

WallSettings const* find_wall(Scene const& scene, std::string const& name)
{
    for (WallSettings const& wall : scene.walls)
        if (wall.name == name) return &wall;
    return nullptr;
}

InteractionSettings const* find_interaction(std::vector<InteractionSettings> const& list, std::string const& a,
                                            std::string const& b)
{
    for (InteractionSettings const& entry : list)
        if ((entry.materials[0] == a && entry.materials[1] == b) || (entry.materials[0] == b && entry.materials[1] == a))
            return &entry;
    return nullptr;
}

} // namespace arenite::scene
