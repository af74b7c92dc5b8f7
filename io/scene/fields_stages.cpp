// SPDX-License-Identifier: MIT
#include "io/scene/schema.hpp"

namespace arenite::scene {
namespace {

Choice axis_choice(int& axis)
{
    return {{"x", "y", "z"}, [&axis] { return axis; }, [&axis](int i) { axis = i; }};
}

Fields servo_fields(ServoSettings& s)
{
    return {
        {"stress", &s.stress, "Pa", "to hold on the area, compression positive; or", not_negative()},
        {"force", &s.force, "N", "to hold", not_negative()},
        standing_for("the domain's cross-section", {"area", &s.area, "m2", "that stress acts on", not_negative()}),
        required({"axis", &s.axis, "", "direction in which the wall moves to press, of any length but 0"}),
        required({"max_speed", &s.max_speed, "m/s", "the wall moves no faster", positive()}),
    };
}

Fields action_fields(WallAction& a)
{
    return {
        required({"wall", &a.wall, "", "name of the wall"}),
        {"present", &a.present, "", "true adds it, false removes it"},
        {"velocity", &a.velocity, "m/s", "moves so"},
        {"angular_velocity", &a.angular_velocity, "rad/s", "turns so about its point, base, box centre or offset"},
        {"servo", optional_table_of(a.servo, servo_fields), "", "moves so that the force on it meets a target"},
        {"open", WordList{&a.open, {}}, "", "holes to open, by name"},
        {"close", WordList{&a.close, {}}, "", "holes to close, by name"},
        {"travel", &a.travel, "m", "goes this far along velocity and stops", positive()},
        {"and_back", &a.and_back, "", "returns from there at the same speed"},
        {"ramp_time", &a.ramp_time, "s", "over which velocity is reached and left", not_negative()},
    };
}

Fields end_fields(EndSettings& e)
{
    auto const stress = [&e] { return !e.stress_wall.empty(); };
    auto const position = [&e] { return !e.position_wall.empty(); };
    return {
        {"kinetic_energy_ratio", &e.kinetic_energy_ratio, "",
         "kinetic over elastic contact energy, of grains and walls, is below", positive()},
        {"kinetic_energy", &e.kinetic_energy, "J", "kinetic energy is below", positive()},
        {"stress_wall", &e.stress_wall, "", "wall whose stress is looked at"},
        required(only_when(stress, "stress_wall", {"stress", &e.stress, "Pa", "is reached on that wall", positive()})),
        only_when(stress, "stress_wall", {"stress_tolerance", &e.stress_tolerance, "", "relative", between_open(0, 1)}),
        only_when(stress, "stress_wall",
                  standing_for("the domain's cross-section",
                               {"stress_area", &e.stress_area, "m2", "of that wall", not_negative()})),
        {"porosity", &e.porosity, "", "is at or below", between_open(0, 1)},
        {"position_wall", &e.position_wall, "", "wall whose position is looked at"},
        only_when(position, "position_wall", {"position_axis", axis_choice(e.position_axis), "", "along this axis"}),
        required(only_when(position, "position_wall", {"position", &e.position, "m", "is reached by that wall"})),
        {"wall_travel_done", &e.wall_travel_done, "", "every wall with a travel has made it"},
        {"box_stress_tolerance", &e.box_stress_tolerance, "",
         "every axis of the box that holds a stress has it, to this relative tolerance", between_open(0, 1)},
    };
}

/// The axes are two arrays in memory and three tables in the file.
SubTable box_axis(BoxSettings& box, std::size_t axis)
{
    auto const fields = [](BoxSettings& b, std::size_t i) {
        return Fields{{"strain_rate", &b.strain_rate[i], "1/s", "positive stretches; or"},
                      {"stress", &b.stress[i], "Pa", "to hold, compression positive"}};
    };
    return {true, [&box, axis] { return box.strain_rate[axis] || box.stress[axis]; },
            [&box, axis, fields] { return fields(box, axis); },
            [axis, fields] { return fields(example_of<BoxSettings>(), axis); }};
}

Fields box_fields(BoxSettings& b)
{
    return {
        {"x", box_axis(b, 0), "", "what the box does along x; an axis without a table stays as it is"},
        {"y", box_axis(b, 1), "", "along y"},
        {"z", box_axis(b, 2), "", "along z"},
        {"max_strain_rate", &b.max_strain_rate, "1/s",
         "of axes that hold a stress: the largest, which answers a stress that is off by its own size; beside an axis with "
         "a "
         "strain rate they also learn the rate that lasts",
         not_negative()},
    };
}

/// Overrides start from the scene's material, so that a stage names only what differs.
TableMap override_map(StageSettings& stage, std::vector<MaterialSettings> const& materials)
{
    auto const names = [&stage] {
        std::vector<std::string> list;
        for (auto const& [name, material] : stage.materials) list.push_back(name);
        return list;
    };
    auto const create = [&stage, &materials](std::string const& name) {
        auto const [slot, made] = stage.materials.try_emplace(name);
        if (made) {
            slot->second.name = name;
            for (MaterialSettings const& material : materials)
                if (material.name == name) slot->second = material;
        }
        Fields fields = material_fields(slot->second);
        for (Field& field : fields) field.required = false;
        return fields;
    };
    return {names, create, {}};
}

Fields stage_action_fields(StageSettings& s, std::vector<MaterialSettings> const& materials)
{
    return {
        {"contact", table_of(s.contact, contact_fields), "", "law between grains"},
        {"wall_contact", table_of(s.wall_contact, contact_fields), "", "law between grains and walls"},
        {"materials", override_map(s, materials), "",
         "values of a material during this stage, by its name; keys that are not written keep the scene's value"},
        {"interactions", list_of(s.interactions, interaction_fields), "",
         "values of a pair during this stage; keys that are not written keep those of the scene's entry of the pair"},
        {"walls", list_of(s.walls, action_fields, "wall"), "", "what is done with walls; the others rest"},
        {"box", optional_table_of(s.box, box_fields), "", "a periodic box that deforms"},
        {"end", table_of(s.end, end_fields), "", "the stage ends when all of these hold at once"},
    };
}

} // namespace

Fields stage_fields(StageSettings& s, std::vector<MaterialSettings> const& materials)
{
    Fields fields{
        required({"name", &s.name, "", "of your choice; --until takes it"}),
        {"kind", choice(s.kind, {"dynamics", "generation", "compression"}), "",
         "dynamics: Newton's equations; generation: puts the grains of a distribution into place; compression: a "
         "faster path to a compressed pack at rest"},
        {"duration", &s.duration, "s", "with end conditions: the most that it may take", not_negative()},
        {"time_step", &s.time_step, "s", "of the grains; or", not_negative()},
        {"time_step_fraction", &s.time_step_fraction, "", "of the critical step", between(0, 1)},
        standing_for("the domain's", {"gravity", &s.gravity, "m/s2", "during this stage"}),
        {"fluid", &s.fluid, "",
         "the fluid flows during this stage: on from the stage before, from its initial state after one without; not beside "
         "a box that strains"},
        {"outlet_wall", &s.outlet_wall, "",
         "plane wall; grains that are wholly through an open hole of it, or in it and outside the domain, are produced and "
         "leave"},
        {"local_damping", &s.local_damping, "",
         "share of the unbalanced force that opposes motion (quasi-static stages only)", between(0, 1)},
        standing_for("true for pairs that did not adhere under modified_jkr in the stage before",
                     {"form_bonds", &s.form_bonds, "",
                      "with law = \"modified_jkr\", of grains, walls or a pair: what touches at the start is bonded"}),
        {"carrier", &s.carrier, "",
         "plane wall; grains ride on the homogeneous strain that its motion means for the domain (fast, even "
         "compression); not beside a box that strains, nor fluid"},
        standing_for("friction stays",
                     {"target_porosity", &s.target_porosity, "",
                      "with a servo: friction falls until the porosity under its stress is this", between(0, 1)}),
        standing_for("the output's", {"history_interval", &s.history_interval, "s", "during this stage", not_negative()}),
        standing_for("the output's", {"field_interval", &s.field_interval, "s", "during this stage", not_negative()}),
        standing_for("the output's",
                     {"checkpoint_interval", &s.checkpoint_interval, "s", "during this stage", not_negative()}),
    };
    for (Field& field : stage_action_fields(s, materials)) fields.push_back(std::move(field));
    return fields;
}

} // namespace arenite::scene
