// SPDX-License-Identifier: MIT
// The whole file's top level, the domain, and what matter is made of and how it touches.
#include "io/scene/schema.hpp"

namespace arenite::scene {
namespace {

Fields domain_fields(DomainSettings& d)
{
    return {
        required({"lower", &d.lower, "m", "lower corner of the box that the study lives in"}),
        required({"upper", &d.upper, "m", "upper corner"}),
        {"periodic", &d.periodic, "", "per axis: what leaves through one face comes in through the other"},
        {"gravity", &d.gravity, "m/s2", "acceleration of grains and fluid"},
    };
}

TableMap material_map(std::vector<MaterialSettings>& materials)
{
    auto const names = [&materials] {
        std::vector<std::string> list;
        for (MaterialSettings const& material : materials) list.push_back(material.name);
        return list;
    };
    auto const create = [&materials](std::string const& name) {
        for (MaterialSettings& material : materials)
            if (material.name == name) return material_fields(material);
        materials.emplace_back().name = name;
        return material_fields(materials.back());
    };
    return {names, create, [] { return material_fields(example_of<MaterialSettings>()); }};
}

} // namespace

Fields scene_fields(Scene& s)
{
    return {
        {"title", &s.title, "", "what the study is about, for reports"},
        {"random_seed", &s.random_seed, "", "of every random number; the same seed gives the same run"},
        {"domain", table_of(s.domain, domain_fields), "", "the box"},
        {"materials", material_map(s.materials), "", "of grains and walls, by a name of your choice"},
        {"interactions", list_of(s.interactions, interaction_fields), "", "values of a pair of materials"},
        {"coarse_graining", table_of(s.coarse_graining, coarse_graining_fields), "", "fewer, larger grains"},
        {"particles", table_of(s.particles, particles_fields), "", "where the grains come from"},
        {"groups", list_of(s.groups, group_fields, "name"), "", "something done to chosen grains"},
        {"walls", list_of(s.walls, wall_fields, "name"), "", "what grains bounce off"},
        {"fluid", optional_table_of(s.fluid, fluid_fields), "", "the water; without this table there is none"},
        {"stages",
         TableList{[&s] { return s.stages.size(); }, [&s](std::size_t i) { return stage_fields(s.stages[i], s.materials); },
                   [&s] { return stage_fields(s.stages.emplace_back(), s.materials); },
                   [] { return stage_fields(example_of<StageSettings>(), example_of<std::vector<MaterialSettings>>()); },
                   "name"},
         "", "what happens, one after the other"},
        {"output", table_of(s.output, output_fields), "", "what is written and when"},
    };
}

Fields material_fields(MaterialSettings& m)
{
    auto const deforms = [&m] { return !m.rigid; };
    return {
        {"rigid", &m.rigid, "", "does not deform (walls)"},
        standing_for("not needed by walls", {"density", &m.density, "kg/m3", "of the solid itself", not_negative()}),
        required(only_when(deforms, "rigid = false", {"youngs_modulus", &m.youngs_modulus, "Pa", "stiffness", positive()})),
        required(only_when(deforms, "rigid = false",
                           {"poissons_ratio", &m.poissons_ratio, "", "Poisson's ratio", between_open(-1, 0.5)})),
        {"restitution", &m.restitution, "", "rebound speed over impact speed", above_up_to(0, 1)},
        {"friction", &m.friction, "", "Coulomb coefficient", not_negative()},
        {"surface_energy", &m.surface_energy, "J/m2",
         "gamma of the original grains; the work of adhesion is 2 gamma; coarse grains get k gamma", not_negative()},
    };
}

Fields contact_fields(ContactSettings& c)
{
    return {
        {"law", choice(c.normal, {"hertz", "jkr", "modified_jkr"}), "",
         "normal force; modified_jkr bonds what touches when the stage begins, and a broken bond stays broken"},
        standing_for("\"S\" with law = \"jkr\", else \"C\"",
                     {"break_point", choice(c.break_point, {"A", "C", "S"}), "",
                      "where an adhesive contact ends: A no overlap, C largest tension, S snap"}),
        {"friction_limit", choice(c.friction_limit, {"paper", "thornton"}), "",
         "paper: mu |F_n|; thornton: mu (F_n + 2 F_C) while the contact adheres, mu F_n afterwards"},
        {"tangential", choice(c.tangential, {"none", "secant", "rescaled", "incremental", "dissipative"}), "",
         "tangential spring; none: no friction"},
        {"damping", choice(c.damping, {"none", "restitution", "restitution_clipped"}), "",
         "clipped: damping never makes a contact attract"},
    };
}

Fields interaction_fields(InteractionSettings& i)
{
    return {
        required({"materials", &i.materials, "", "the two names; the same twice for a material with itself"}),
        {"restitution", &i.restitution, "", "of the pair", above_up_to(0, 1)},
        {"friction", &i.friction, "", "of the pair", not_negative()},
        {"surface_energy", &i.surface_energy, "J/m2", "of the pair, at k = 1", not_negative()},
        {"contact", optional_table_of(i.contact, contact_fields), "", "law of the pair, instead of the stage's"},
    };
}

Fields coarse_graining_fields(CoarseGrainingSettings& c)
{
    auto const coarse = [&c] { return c.scheme != CoarseGraining::none; };
    return {
        {"scheme", choice(c.scheme, {"none", "ssw", "ssp"}), "",
         "ssw: every size class times k; ssp: one size, k times the mean-volume diameter"},
        only_when(coarse, "scheme = \"ssw\" or \"ssp\"",
                  {"factor", &c.factor, "", "k, grain diameter over original diameter", at_least(1)}),
    };
}

} // namespace arenite::scene
