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
    return std::any_of(scene.stages.begin(), scene.stages.end(), [](StageSettings const& stage) { return stage.box.has_value(); });
}

std::vector<std::string> balance_columns(bool fluid)
{
    std::vector<std::string> names{"rotation_energy",     "elastic_energy", "adhesive_energy",     "tangential_energy",  "work_walls",
                                   "work_box",            "work_gravity",   "work_drag",           "work_pressure",      "work_applied",
                                   "work_held",           "loss_damping",   "loss_tangential",     "loss_adhesion",      "loss_local_damping",
                                   "energy_removed",      "energy_residual", "momentum_x",          "momentum_y",         "momentum_z"};
    if (fluid)
        for (char const* name : {"fluid_energy", "fluid_momentum_x", "fluid_momentum_y", "fluid_momentum_z", "fluid_volume"})
            names.push_back(name);
    return names;
}

std::vector<std::optional<Real>> balance_row(Look const& look, bool fluid_columns, RunState& state)
{
    EnergySheet const& e = *look.energy;
    auto const work = [&](Work which) { return e.work[static_cast<int>(which)]; };
    Vec3 const p = look.grains.momentum;
    std::vector<std::optional<Real>> row{e.rotation,
                                         e.stored.elastic,
                                         e.stored.adhesive,
                                         e.stored.tangential,
                                         work(Work::walls),
                                         work(Work::box),
                                         work(Work::gravity),
                                         work(Work::drag),
                                         work(Work::pressure),
                                         work(Work::applied),
                                         work(Work::held),
                                         e.loss_normal_damping,
                                         e.loss_tangential,
                                         e.loss_adhesion,
                                         e.loss_local_damping,
                                         e.removed,
                                         e.residual,
                                         p.x,
                                         p.y,
                                         p.z};
    if (fluid_columns && !state.fluid) row.resize(row.size() + 5);
    if (!state.fluid) return row;
    FluidTotals const fluid = fluid_totals(state.fluid->flow, state.sums);
    row.insert(row.end(), {fluid.kinetic_energy, fluid.momentum.x, fluid.momentum.y, fluid.momentum.z, fluid.volume});
    return row;
}

} // namespace

std::vector<std::string> extra_columns(Scene const& scene)
{
    std::vector<std::string> names;
    if (box_deforms(scene)) names = {"box_x", "box_y", "box_z", "stress_x", "stress_y", "stress_z"};
    if (!scene.output.energies) return names;
    std::vector<std::string> const balance = balance_columns(scene.fluid.has_value());
    names.insert(names.end(), balance.begin(), balance.end());
    return names;
}

std::vector<std::optional<Real>> extra_values(Scene const& scene, Look const& look, RunState& state)
{
    std::vector<std::optional<Real>> values;
    if (box_deforms(scene)) {
        Vec3 const size = state.box.size(), stress = mean_stress(state.particles, state.box, state.contacts, state.sums);
        values = {size.x, size.y, size.z, stress.x, stress.y, stress.z};
    }
    if (!look.energy) return values;
    std::vector<std::optional<Real>> const balance = balance_row(look, scene.fluid.has_value(), state);
    values.insert(values.end(), balance.begin(), balance.end());
    return values;
}

} // namespace arenite
