// SPDX-License-Identifier: MIT
#include "apps/run_checkpoint.hpp"

#include "apps/make_state.hpp"
#include "io/checkpoint.hpp"
#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace arenite {
namespace {

/// Calls f(name, member) for everything of fixed size.
template <class State, class Function> void for_each_number(State& state, Function const& f)
{
    f("clock/stage", state.clock.stage);
    f("clock/step", state.clock.step);
    f("clock/stage_step", state.clock.stage_step);
    f("clock/stage_start", state.clock.stage_start);
    f("clock/dt", state.clock.dt);
    f("tally/produced_mass", state.tally.produced_mass);
    f("tally/produced_count", state.tally.produced_count);
    f("tally/lost_mass", state.tally.lost_mass);
    f("tally/lost_count", state.tally.lost_count);
    f("tally/stage_produced_mass", state.stage_tally.produced_mass);
    f("tally/stage_produced_count", state.stage_tally.produced_count);
    f("tally/stage_lost_mass", state.stage_tally.lost_mass);
    f("tally/stage_lost_count", state.stage_tally.lost_count);
    f("record/highest_overlap_ratio", state.record.highest_overlap_ratio);
    f("record/highest_step_ratio", state.record.highest_step_ratio);
    f("search/skin", state.skin);
    f("search/last", state.last_search);
    f("stage/tuned_friction", state.tuned_friction);
    static char const* const names[] = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        f(std::string("box/lower_") + names[axis], state.box.lower[axis]);
        f(std::string("box/upper_") + names[axis], state.box.upper[axis]);
        f(std::string("box/strain_rate_") + names[axis], state.box.strain_rate[axis]);
        f(std::string("box/lasting_strain_rate_") + names[axis], state.lasting_strain_rate[axis]);
    }
}

/// Calls f(name, view) for every View of the grains and of their list; some may be unallocated.
template <class State, class Function> void for_each_array(State& state, Function const& f)
{
    f("particles/position", state.particles.position);
    f("particles/velocity", state.particles.velocity);
    f("particles/spin", state.particles.spin);
    f("particles/force", state.particles.force);
    f("particles/torque", state.particles.torque);
    f("particles/id", state.particles.id);
    f("particles/material", state.particles.material);
    f("particles/size_class", state.particles.size_class);
    f("particles/applied_force", state.particles.applied_force);
    f("particles/fluid_force", state.particles.fluid_force);
    f("particles/coasting", state.particles.coasting);
    f("particles/pressure_force", state.particles.pressure_force);
    f("contacts/row_begin", state.contacts.row_begin);
    f("contacts/reference_position", state.contacts.reference_position);
}

/// Likewise for every View that has a row per contact.
template <class State, class Function> void for_each_contact_array(State& state, Function const& f)
{
    f("contacts/second", state.contacts.second);
    f("contacts/image", state.contacts.image);
    f("contacts/touching", state.contacts.touching);
    f("contacts/adhering", state.contacts.adhering);
    f("contacts/spring", state.contacts.spring);
    f("contacts/contact_radius", state.contacts.contact_radius);
    f("contacts/force", state.contacts.force);
}

/// A copy of the first rows: what lies beyond them is no part of the state.
template <class ViewType> ViewType first_rows(ViewType const& view, int count)
{
    ViewType const rows(uninitialized(view.label()), count);
    Kokkos::deep_copy(rows, rows_of(view, 0, count));
    return rows;
}

void save_energy(CheckpointWriter& out, EnergyAccount const& account)
{
    WorkSums const sums = account.read_sums();
    auto const array = [](WorkArray const& a) { return std::vector<Real>(a.values, a.values + work_count); };
    out.array("energy/power", array(sums.power));
    out.array("energy/work", array(sums.work));
    out.array("energy/sums", std::vector<Real>{sums.adhesion, account.removed, account.start, account.start_tangential});
}

EnergyAccount load_energy(CheckpointReader const& in)
{
    EnergyAccount account;
    std::vector<Real> const power = in.array<Real>("energy/power"), work = in.array<Real>("energy/work"),
                            totals = in.array<Real>("energy/sums");
    WorkSums sums;
    for (int n = 0; n < work_count; ++n) {
        sums.power.values[n] = power.at(n);
        sums.work.values[n] = work.at(n);
    }
    sums.adhesion = totals.at(0);
    account.write_sums(sums);
    account.removed = totals.at(1);
    account.start = totals.at(2);
    account.start_tangential = totals.at(3);
    return account;
}

/// Motion as bytes, since a checkpoint knows numbers only.
View1<std::uint8_t> motion_bytes(Particles const& particles)
{
    View1<std::uint8_t> const bytes(uninitialized("motion_bytes"), particles.count);
    View1<Motion> const motion = particles.motion;
    Kokkos::parallel_for(
        "motion_bytes", RangePolicy(0, particles.count),
        KOKKOS_LAMBDA(int i) { bytes(i) = static_cast<std::uint8_t>(motion(i)); });
    return bytes;
}

void restore_motion(View1<std::uint8_t> const& bytes, Particles& particles)
{
    particles.motion = View1<Motion>(uninitialized("motion"), bytes.extent(0));
    View1<Motion> const motion = particles.motion;
    Kokkos::parallel_for(
        "restore_motion", RangePolicy(0, static_cast<int>(bytes.extent(0))),
        KOKKOS_LAMBDA(int i) { motion(i) = static_cast<Motion>(bytes(i)); });
}

void save_named(CheckpointWriter& out, std::string const& group, std::map<std::string, std::vector<Real>> const& arrays)
{
    for (auto const& [name, values] : arrays) out.array(group + name, values);
}

std::map<std::string, std::vector<Real>> load_named(CheckpointReader const& in, std::string const& group)
{
    std::map<std::string, std::vector<Real>> arrays;
    for (std::string const& name : in.names())
        if (name.rfind(group, 0) == 0) arrays[name.substr(group.size())] = in.array<Real>(name);
    return arrays;
}

void save_groups(CheckpointWriter& out, GrainGroups const& groups)
{
    auto const save = [&](std::string const& name, std::set<GrainId> const& ids) {
        out.array("groups/" + name, std::vector<GrainId>(ids.begin(), ids.end()));
    };
    for (std::size_t g = 0; g < groups.members.size(); ++g) save("member_" + std::to_string(g), groups.members[g]);
    save("held", groups.held);
    std::vector<GrainId> ids;
    std::vector<Real> forces;
    for (auto const& [id, force] : groups.force) {
        ids.push_back(id);
        for (int axis = 0; axis < 3; ++axis) forces.push_back(force[axis]);
    }
    out.array("groups/forced", ids);
    out.array("groups/force", forces);
}

GrainGroups load_groups(CheckpointReader const& in, std::size_t count)
{
    auto const load = [&](std::string const& name) {
        std::vector<GrainId> const ids = in.array<GrainId>("groups/" + name);
        return std::set<GrainId>(ids.begin(), ids.end());
    };
    GrainGroups groups;
    for (std::size_t g = 0; g < count; ++g) groups.members.push_back(load("member_" + std::to_string(g)));
    groups.held = load("held");
    std::vector<GrainId> const ids = in.array<GrainId>("groups/forced");
    std::vector<Real> const forces = in.array<Real>("groups/force");
    for (std::size_t i = 0; i < ids.size(); ++i)
        groups.force[ids[i]] = {forces.at(3 * i), forces.at(3 * i + 1), forces.at(3 * i + 2)};
    return groups;
}

void save_fluid(CheckpointWriter& out, FluidState& fluid)
{
    for_each_state_field(fluid.flow, fluid.solver, [&](std::string const& name, auto& field) {
        if constexpr (std::is_same_v<std::decay_t<decltype(field)>, Real>) out.value("fluid/" + name, field);
        else if (field.is_allocated()) out.array("fluid/" + name, field);
    });
    out.array("fluid_box", std::vector<Real>{fluid.box.lower.x, fluid.box.lower.y, fluid.box.lower.z, fluid.box.upper.x,
                                             fluid.box.upper.y, fluid.box.upper.z});
    out.value("fluid/with_grains", fluid.flow.has_drag() ? 1 : 0);
    FlowReport const& report = fluid.report;
    out.array("fluid_report", std::vector<Real>{static_cast<Real>(report.pressure_iterations), report.pressure_residual,
                                                report.continuity_error, report.courant, report.inflow, report.outflow,
                                                report.velocity_converged ? Real(1) : Real(0),
                                                report.pressure_converged ? Real(1) : Real(0)});
    CoupledSet const& coupled = fluid.exchange.coupled;
    out.value("coupled/count", coupled.count);
    out.value("coupled/digest", static_cast<std::int64_t>(coupled.digest));
    if (coupled.count > 0) {
        out.array("coupled/id", first_rows(coupled.id, coupled.count));
        out.array("coupled/position", first_rows(coupled.position, coupled.count));
    }
}

void load_fluid(CheckpointReader const& in, Scene const& scene, PlannedStage const& planned, RunState& state)
{
    Particles const held = state.particles; // forces held between fluid steps
    std::vector<Real> const b = in.array<Real>("fluid_box");
    bool const with_grains = in.value<int>("fluid/with_grains") != 0;
    prepare_fluid(scene, planned, state,
                  KnownFluid{{{b.at(0), b.at(1), b.at(2)}, {b.at(3), b.at(4), b.at(5)}}, with_grains});
    if (held.fluid_force.is_allocated()) state.particles.fluid_force = held.fluid_force;
    if (held.coasting.is_allocated()) state.particles.coasting = held.coasting;
    if (held.pressure_force.is_allocated()) state.particles.pressure_force = held.pressure_force;
    FluidState& fluid = *state.fluid;
    for_each_state_field(fluid.flow, fluid.solver, [&](std::string const& name, auto& field) {
        if constexpr (std::is_same_v<std::decay_t<decltype(field)>, Real>) field = in.value<Real>("fluid/" + name);
        else if (in.has("fluid/" + name)) in.view("fluid/" + name, field);
    });
    std::vector<Real> const r = in.array<Real>("fluid_report");
    fluid.report = {static_cast<int>(r.at(0)), r.at(1), r.at(2), r.at(3), r.at(4), r.at(5), r.at(6) != 0, r.at(7) != 0};
    CoupledSet& coupled = fluid.exchange.coupled;
    coupled.count = in.value<int>("coupled/count");
    coupled.digest = static_cast<std::uint64_t>(in.value<std::int64_t>("coupled/digest"));
    if (coupled.count > 0) {
        in.view("coupled/id", coupled.id);
        in.view("coupled/position", coupled.position);
    }
}

} // namespace

std::uint64_t past_hash(Scene const& scene, StagePlan const& plan, CheckpointStamp const& stamp, std::uint64_t inputs)
{
    auto const last = std::find_if(plan.begin(), plan.end(), [&](auto const& p) { return p.label == stamp.stage; });
    if (last == plan.end()) return 0;
    Scene past = scene;
    past.title.clear();
    past.output = {};
    past.stages.resize(last->scene_stage + 1);
    if (std::none_of(past.stages.begin(), past.stages.end(), [](auto const& s) { return s.fluid; })) past.fluid.reset();
    for (StageSettings& stage : past.stages) stage.history_interval = stage.field_interval = stage.checkpoint_interval = {};
    bool const runs = !stamp.stage_end || (last + 1 != plan.end() && (last + 1)->scene_stage == last->scene_stage);
    if (runs) {
        past.stages.back().duration = 0;
        past.stages.back().end = {};
    }
    return hash_of(fmt::format("{}# inputs {:016x}\n", resolved_scene(past), inputs));
}

void save_checkpoint(std::filesystem::path const& path, Scene const& scene, StagePlan const& plan, RunState& state,
                     bool stage_end)
{
    CheckpointStamp stamp{state.clock.step, state.clock.time(), plan[state.clock.stage - (stage_end ? 1 : 0)].label,
                          stage_end};
    stamp.scene_hash = past_hash(scene, plan, stamp, state.inputs);
    CheckpointWriter out(path, stamp);
    for_each_number(state, [&](std::string const& name, auto const& number) { out.value(name, number); });
    for_each_array(state, [&](std::string const& name, auto const& view) {
        if (view.is_allocated()) out.array(name, view);
    });
    for_each_contact_array(state, [&](std::string const& name, auto const& view) {
        if (view.is_allocated()) out.array(name, first_rows(view, state.contacts.count));
    });
    out.array("particles/motion", motion_bytes(state.particles));
    // For a scene that takes its grains from here and may have its materials in another order.
    out.value("materials/count", static_cast<int>(scene.materials.size()));
    for (std::size_t row = 0; row < scene.materials.size(); ++row)
        out.text(fmt::format("materials/{}", row), scene.materials[row].name);
    if (state.energy) save_energy(out, *state.energy);
    save_groups(out, state.groups);
    out.value("contacts/count", state.contacts.count);
    out.value("contacts/tile_grains", state.contacts.tile_grains);
    save_named(out, "walls/", save_walls(state.walls));
    save_named(out, "wall_contacts/", save_wall_contacts(state.wall_contacts));
    out.value("fluid/present", state.fluid ? 1 : 0);
    if (state.fluid) save_fluid(out, *state.fluid);
    out.commit();
}

RunState load_checkpoint(std::filesystem::path const& path, Scene const& scene, StagePlan const& plan)
{
    CheckpointReader const in(path);
    RunState state = make_run_state(scene);
    in.require_scene(past_hash(scene, plan, in.stamp(), state.inputs));
    for_each_number(state,
                    [&](std::string const& name, auto& number) { number = in.value<std::decay_t<decltype(number)>>(name); });
    auto const load = [&](std::string const& name, auto& view) {
        view = {};
        if (in.has(name)) in.view(name, view);
    };
    for_each_array(state, load);
    for_each_contact_array(state, load);
    View1<std::uint8_t> motion;
    in.view("particles/motion", motion);
    restore_motion(motion, state.particles);
    state.particles.count = static_cast<int>(state.particles.id.extent(0));
    // A balance may be asked for from here on, or no longer: output is the scene's to change.
    if (!scene.output.energies) state.particles.pressure_force = {};
    else if (in.has("energy/work")) state.energy = load_energy(in);
    state.groups = load_groups(in, scene.groups.size());
    state.contacts.count = in.value<int>("contacts/count");
    state.contacts.tile_grains =
        in.has("contacts/tile_grains") ? in.value<int>("contacts/tile_grains") : 0; // of older files
    state.contacts.periodic = state.box.any_periodic();
    state.contacts.needs = {state.contacts.spring.is_allocated(), state.contacts.adhering.is_allocated(),
                            state.contacts.contact_radius.is_allocated()};
    restore_walls(state.walls, load_named(in, "walls/"));
    state.wall_contacts = restore_wall_contacts(load_named(in, "wall_contacts/"));
    if (in.value<int>("fluid/present")) {
        bool const between = state.clock.stage_step == 0; // the next stage may drop the fluid: then the one before had it
        load_fluid(in, scene, plan[state.clock.stage - (between ? 1 : 0)], state);
    }
    return state;
}

} // namespace arenite
