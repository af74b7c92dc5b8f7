// SPDX-License-Identifier: MIT
#include "apps/history_columns.hpp"

#include "apps/run_state.hpp"
#include "apps/stage_watch.hpp"
#include "fluid/flow_balance.hpp"
#include "kernels/stress.hpp"

#include <algorithm>

namespace arenite {
namespace {

bool box_deforms(Scene const& scene)
{
    return std::any_of(scene.stages.begin(), scene.stages.end(),
                       [](StageSettings const& stage) { return stage.box.has_value(); });
}

struct NamedValue {
    char const* name;
    std::optional<Real> value;
};

/// One list for the names and for the values, here and below: of an empty sheet it gives the names.
std::vector<NamedValue> balance(EnergySheet const& e, GrainReport const& grains)
{
    Vec3 const p = grains.momentum;
    return {{"rotation_energy", grains.rotation},
            {"elastic_energy", e.stored.elastic},
            {"adhesive_energy", e.stored.adhesive},
            {"tangential_energy", e.stored.tangential},
            {"work_walls", e.work[Work::walls]},
            {"work_box", e.work[Work::box]},
            {"work_gravity", e.work[Work::gravity]},
            {"work_drag", e.work[Work::drag]},
            {"work_pressure", e.work[Work::pressure]},
            {"work_applied", e.work[Work::applied]},
            {"work_held", e.work[Work::held]},
            {"loss_damping", e.loss_normal_damping},
            {"loss_tangential", e.loss_tangential},
            {"loss_adhesion", e.loss_adhesion},
            {"loss_local_damping", e.loss_local_damping},
            {"energy_removed", e.removed},
            {"energy_residual", e.residual},
            {"momentum_x", p.x},
            {"momentum_y", p.y},
            {"momentum_z", p.z}};
}

std::vector<NamedValue> fluid_balance(std::optional<FluidTotals> const& fluid)
{
    auto const value = [&](auto const& of) { return fluid ? std::optional<Real>(of(*fluid)) : std::nullopt; };
    return {{"fluid_energy", value([](FluidTotals const& f) { return f.kinetic_energy; })},
            {"fluid_momentum_x", value([](FluidTotals const& f) { return f.momentum.x; })},
            {"fluid_momentum_y", value([](FluidTotals const& f) { return f.momentum.y; })},
            {"fluid_momentum_z", value([](FluidTotals const& f) { return f.momentum.z; })},
            {"fluid_volume", value([](FluidTotals const& f) { return f.volume; })}};
}

std::vector<NamedValue> box_values(Vec3 const& size, Vec3 const& stress)
{
    return {{"box_x", size.x},      {"box_y", size.y},      {"box_z", size.z},
            {"stress_x", stress.x}, {"stress_y", stress.y}, {"stress_z", stress.z}};
}

void append(std::vector<NamedValue>& list, std::vector<NamedValue> const& more)
{
    list.insert(list.end(), more.begin(), more.end());
}

} // namespace

std::vector<std::string> extra_columns(Scene const& scene)
{
    std::vector<NamedValue> columns;
    if (box_deforms(scene)) append(columns, box_values({}, {}));
    if (scene.output.energies) append(columns, balance({}, {}));
    if (scene.output.energies && scene.fluid) append(columns, fluid_balance({}));
    std::vector<std::string> names;
    for (NamedValue const& column : columns) names.emplace_back(column.name);
    return names;
}

std::vector<std::optional<Real>> extra_values(Scene const& scene, Look const& look, RunState& state)
{
    std::vector<NamedValue> columns;
    if (box_deforms(scene))
        append(columns, box_values(state.box.size(), mean_stress(state.particles, state.box, state.contacts, state.sums)));
    if (look.energy) append(columns, balance(*look.energy, look.grains));
    if (look.energy && scene.fluid) {
        std::optional<FluidTotals> fluid;
        if (state.fluid) fluid = fluid_totals(state.fluid->flow, state.sums);
        append(columns, fluid_balance(fluid));
    }
    std::vector<std::optional<Real>> values;
    for (NamedValue const& column : columns) values.push_back(column.value);
    return values;
}

} // namespace arenite
