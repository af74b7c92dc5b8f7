// SPDX-License-Identifier: MIT
#include "apps/run_output.hpp"

#include "apps/history_columns.hpp"
#include "apps/run_checkpoint.hpp"
#include "apps/sample.hpp"
#include "apps/seconds_of.hpp"
#include "apps/stage_watch.hpp"
#include "io/checkpoint_folder.hpp"
#include "io/wall_surfaces.hpp"
#include "kernels/contact_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace arenite {
namespace {

HistoryColumns columns_of(Scene const& scene)
{
    HistoryColumns columns;
    for (WallSettings const& wall : scene.walls) columns.walls.push_back(wall.name);
    columns.fluid = scene.fluid.has_value();
    columns.extra = extra_columns(scene);
    return columns;
}

std::int64_t steps_of(Real interval, Real dt)
{
    constexpr Real never = 1e15; // steps; what is beyond fits no integer
    return interval > 0 ? std::max<std::int64_t>(1, std::llround(std::min(interval / dt, never))) : 0;
}

/// m2 that the stage gives for the stress on a wall; 0: none.
Real area_of(std::string const& wall, StageSettings const& stage)
{
    for (WallAction const& action : stage.walls)
        if (action.wall == wall && action.servo) return action.servo->area;
    return stage.end.stress_wall == wall ? stage.end.stress_area : 0;
}

} // namespace

RunOutput::RunOutput(std::filesystem::path folder, Scene const& scene, StagePlan const& plan,
                     std::optional<ResumePoint> const& resume, int first_stage, bool quiet)
    : folder_(std::move(folder)), resume_(resume), scene_(scene), plan_(plan), history_(folder_, columns_of(scene), resume),
      ledger_(folder_, resume), probes_(folder_, scene.output, resume), run_begin_(std::chrono::steady_clock::now()),
      quiet_(quiet)
{
    summary_.scene = scene.path;
    summary_.title = scene.title;
    summary_.scene_hash = scene.hash;
    summary_.random_seed = scene.random_seed;
    if (resume) {
        summary_.resumed_from_step = resume->step;
        std::vector<std::string> labels;
        for (int row = 0; row < first_stage; ++row) labels.push_back(plan[row].label);
        summary_.earlier_stages = finished_stages(folder_, labels);
    }
}

void RunOutput::open()
{
    make_folder(folder_);
    remove_unfinished(folder_);
    // Later checkpoints go first: were the tables cut before them, a kill in between would leave a checkpoint
    // without its rows.
    drop_checkpoints_after(folder_, resume_ ? resume_->step : -1);
    flush_tables();
    fields_.emplace(folder_, resume_);
    fields_->choose_grain_fields(scene_.output.grain_fields);
    fields_->choose_fluid_fields(scene_.output.fluid_fields);
    write_file_atomically(folder_ / "scene.toml", scene_.resolved);
}

OutputCadence RunOutput::cadence(PlannedStage const& planned) const
{
    StageSettings const& stage = planned.settings;
    OutputSettings const& output = scene_.output;
    Real const history = stage.history_interval.value_or(output.history_interval);
    constexpr std::int64_t rows_without_duration = 1000; // steps a row where nobody knows how long the stage takes
    OutputCadence cadence;
    cadence.history = steps_of(history, planned.dt);
    if (cadence.history == 0)
        cadence.history =
            stage.duration > 0 && !stage.end.any() ? steps_of(stage.duration / 100, planned.dt) : rows_without_duration;
    cadence.fields = steps_of(stage.field_interval.value_or(output.field_interval), planned.dt);
    cadence.checkpoint = steps_of(stage.checkpoint_interval.value_or(output.checkpoint_interval), planned.dt);
    return cadence;
}

void RunOutput::begin_stage(PlannedStage const& planned, RunState const& state)
{
    planned_ = &planned;
    cadence_ = cadence(planned);
    stage_begin_ = std::chrono::steady_clock::now();
    counted_step_ = state.clock.step;
    summary_.stages.emplace_back();
    stage().name = planned.label;
    TimeStepLimits const& limits = planned.limits;
    std::string line = fmt::format("{}: {} grains", planned.label, state.particles.count);
    if (planned.dt > 0) line += fmt::format(", dt {:.4g} s", planned.dt);
    if (planned.dt > 0 && limits.rayleigh > 0)
        line += fmt::format(", {:.1f} % of Rayleigh's time", 100 * planned.dt / limits.rayleigh);
    if (planned.dt > 0 && limits.lattice > 0)
        line +=
            fmt::format(", {:.1f} % of the lattice limit at {:.3g} Pa", 100 * planned.dt / limits.lattice, limits.pressure);
    say(line);
    warn_of_little_space(state);
}

/// Said before hours are spent. Two checkpoints stay, beside those at the ends of stages, while the next one is written.
void RunOutput::warn_of_little_space(RunState const& state)
{
    double const cells = state.fluid ? static_cast<double>(state.fluid->flow.grid.cell_count()) : 0;
    double const needed = 3 * checkpoint_bytes(state.particles.count, cells);
    std::error_code unknown;
    auto const space = std::filesystem::space(folder_, unknown);
    if (unknown || !can_write_checkpoints() || static_cast<double>(space.available) > needed) return;
    warn("disk", fmt::format("{}: {:.3g} MB are free, and three checkpoints take about {:.3g} MB", folder_.string(),
                             1e-6 * static_cast<double>(space.available), 1e-6 * needed));
}

void RunOutput::write_start(RunState& state, Look const& look)
{
    write_history(state, look);
    write_fields(state);
}

void RunOutput::write_history(RunState& state, Look const& look)
{
    HistoryRow row;
    row.time = state.clock.time();
    row.stage = planned_->label;
    row.step = state.clock.step;
    row.grains = state.particles.count;
    row.contacts = look.contacts.touching;
    row.bonds = look.contacts.adhering;
    row.kinetic_energy = look.grains.kinetic_energy();
    row.porosity = look.porosity;
    if (state.particles.count > 0) row.coordination = 2 * static_cast<Real>(look.contacts.touching) / state.particles.count;
    for (int w = 0; w < state.walls.count(); ++w)
        row.wall_forces.push_back(state.walls.state[w].present ? std::optional<Vec3>(look.walls[w].force) : std::nullopt);
    row.produced_mass = state.tally.produced_mass;
    row.produced_count = state.tally.produced_count;
    row.lost_mass = state.tally.lost_mass;
    row.lost_count = state.tally.lost_count;
    row.max_overlap_ratio = std::max(look.contacts.highest_overlap_ratio, look.wall_overlap_ratio);
    if (state.fluid) row.flow = state.fluid->report;
    row.extra = extra_values(scene_, look, state);
    history_.add(row);
    // A contact radius of 0.3 of the grain's: beyond, the half-spaces of the contact laws are none.
    constexpr Real hertz_limit = 0.1;
    if (row.max_overlap_ratio > hertz_limit)
        warn("overlap",
             fmt::format("step {}: an overlap of {:.3g} of the smaller radius is beyond what the contact laws hold for ({})",
                         state.clock.step, row.max_overlap_ratio, hertz_limit));
    probes_.write(state, planned_->label);
}

void RunOutput::flush_tables()
{
    history_.flush();
    ledger_.flush();
    probes_.flush();
}

void RunOutput::write_fields(RunState& state)
{
    if (last_fields_step_ == state.clock.step && !state.fluid) return;
    last_fields_step_ = state.clock.step;
    GrainCounts counts;
    counts.bonds = View1<int>("bonds", state.particles.count);
    counts.coordination = View1<int>("coordination", state.particles.count);
    count_bonds(state.particles, state.contacts, counts.bonds, counts.coordination);
    fields_->write(take_snapshot(state.particles, state.clock.time(), counts));
    if (state.walls.count() > 0) fields_->write_walls(wall_surfaces(state.walls, state.clock.time()));
    if (!state.fluid) return;
    FluidSnapshot const fluid = take_snapshot(state.fluid->flow, state.clock.time());
    fields_->write(fluid);
    fields_->write_streamlines(fluid, scene_.output.streamlines);
}

void RunOutput::fluid_warnings(RunState const& state)
{
    if (!state.fluid) return;
    ExchangeReport const& report = state.fluid->exchange.report;
    if (report.limited_cells > 0)
        warn("porosity_limited",
             fmt::format("step {}: {} cells held more grains than the minimum porosity allows ({:.4g}); {:.3g} m3 "
                         "of grains are unseen by the fluid",
                         state.clock.step, report.limited_cells, report.lowest_porosity, report.limited_volume));
    FlowReport const& flow = state.fluid->report;
    if (flow.courant > 1 && scene_.fluid->convection != ConvectionScheme::none)
        warn("courant",
             fmt::format("step {}: the fluid's Courant number is {:.3g}: above 1 its convection, which is explicit, "
                         "is not stable; a shorter fluid.time_step helps",
                         state.clock.step, flow.courant));
    if (!flow.velocity_converged)
        warn("velocity_not_converged", fmt::format("step {}: the velocity solve did not converge: the fluid's step is long "
                                                   "for its drag and viscosity",
                                                   state.clock.step));
    if (!flow.pressure_converged)
        warn("pressure_not_converged", fmt::format("step {}: the pressure solve stopped at a relative residual of {:.3g}",
                                                   state.clock.step, flow.pressure_residual));
}

void RunOutput::write_due(StageSetup const& setup, RunState& state, StageWatch& watch, bool ended)
{
    Phase const phase("output");
    std::int64_t const step = state.clock.stage_step;
    if (ended || OutputCadence::due(cadence_.history, step)) write_history(state, watch.look(setup, state));
    if (ended || OutputCadence::due(cadence_.fields, step)) write_fields(state);
    fluid_warnings(state);
    stage().particle_steps += static_cast<Real>(state.particles.count) * static_cast<Real>(state.clock.step - counted_step_);
    counted_step_ = state.clock.step;
    if (!quiet_)
        progress_.update({planned_->label, state.clock.stage_time(), planned_->settings.duration, state.clock.step,
                          state.particles.count});
}

void RunOutput::end_stage(StageSetup const& setup, RunState& state, StageWatch& watch, std::string const& ended_by)
{
    Look const& look = watch.look(setup, state);
    StageSummary& s = stage();
    s.ended_by = ended_by;
    s.wall_time = seconds_since(stage_begin_);
    s.simulated_time = state.clock.stage_time();
    s.steps = state.clock.stage_step;
    s.grains = state.particles.count;
    s.contacts = look.contacts.touching;
    s.bonds = look.contacts.adhering;
    s.porosity = look.porosity;
    if (state.particles.count > 0) s.coordination = 2 * static_cast<Real>(look.contacts.touching) / state.particles.count;
    s.kinetic_energy = look.grains.kinetic_energy();
    s.max_overlap_ratio = state.record.highest_overlap_ratio;
    s.produced_mass = state.tally.produced_mass - state.stage_tally.produced_mass;
    s.produced_count = state.tally.produced_count - state.stage_tally.produced_count;
    s.lost_mass = state.tally.lost_mass - state.stage_tally.lost_mass;
    s.lost_count = state.tally.lost_count - state.stage_tally.lost_count;
    for (int w = 0; w < state.walls.count(); ++w) {
        if (!state.walls.state[w].present) continue;
        WallSummary wall{state.walls.settings[w].name, look.walls[w].force, {}};
        if (state.walls.settings[w].shape == WallShape::plane)
            wall.stress = wall_stress(state.walls, w, look.walls[w], area_of(wall.name, planned_->settings), state.box);
        s.walls.push_back(wall);
    }
    s.values["elastic_energy_J"] = look.elastic_energy();
    s.values["grain_mass_kg"] = look.grains.mass;
    s.values["time_step_s"] = planned_->dt;
    s.values["time_step_over_contact_limit"] = state.record.highest_step_ratio;
    s.values["searches"] = static_cast<Real>(setup.searches);
    s.values["search_time_s"] = setup.search_time;
    if (state.tuned_friction >= 0) s.values["tuned_friction"] = state.tuned_friction;
    if (state.record.highest_step_ratio > 1)
        warn("time_step", fmt::format("{}: the stiffest contact would need a step {:.2f} times smaller to be surely stable",
                                      planned_->label, state.record.highest_step_ratio));
    flush_tables();
    finish("running"); // so that a kill later leaves what is known now
    if (state.particles.count == 0)
        return say(fmt::format("{}: {} after {:.6g} s and {} steps, {:.1f} s", planned_->label, ended_by, s.simulated_time,
                               s.steps, s.wall_time));
    say(fmt::format("{}: {} after {:.6g} s and {} steps; porosity {:.4f}, {:.2f} contacts a grain, {} bonds, kinetic over "
                    "elastic energy "
                    "{:.2e}; {:.1f} s, {:.3g} particle-steps/s",
                    planned_->label, ended_by, s.simulated_time, s.steps, s.porosity.value_or(1), s.coordination.value_or(0),
                    s.bonds, look.elastic_energy() > 0 ? s.kinetic_energy / look.elastic_energy() : 0, s.wall_time,
                    s.wall_time > 0 ? s.particle_steps / s.wall_time : 0));
}

bool RunOutput::checkpoint_is_due(RunState const& state) const
{
    return OutputCadence::due(cadence_.checkpoint, state.clock.stage_step);
}

void RunOutput::write_checkpoint(RunState& state, bool stage_end)
{
    Phase const phase("checkpoint");
    flush_tables();
    if (!can_write_checkpoints()) return;
    save_checkpoint(checkpoint_path(folder_, state.clock.step), scene_, plan_, state, stage_end);
    prune_checkpoints(folder_);
}

Real RunOutput::mass_of(Grain const& grain) const
{
    return scene_.materials[grain.material].density * sphere_volume(grain.diameter / 2);
}

void RunOutput::write_produced(Grain const& grain, RunState const& state)
{
    ledger_.add({state.clock.time(), grain.id, grain.size_class, grain.diameter, scene_.coarse_graining.factor,
                 mass_of(grain), grain.position, grain.velocity});
}

void RunOutput::warn(std::string const& kind, std::string const& message)
{
    constexpr std::int64_t shown = 3;
    if (std::exchange(last_warning_[kind], message) == message) return;
    ++stage().warnings[kind];
    std::int64_t const count = ++warnings_[{planned_->scene_stage, kind}];
    if (count > shown) return;
    progress_.clear();
    std::fputs(
        fmt::format("warning: {}{}\n", message, count == shown ? " (more of this kind are only counted)" : "").c_str(),
        stderr);
}

void RunOutput::say(std::string const& message)
{
    if (quiet_) return;
    progress_.clear();
    std::fputs((message + "\n").c_str(), stdout);
    std::fflush(stdout);
}

void RunOutput::finish_after(std::string const& failure)
{
    auto const as_far_as_it_goes = [](auto const& write) {
        try {
            write();
        } catch (std::exception const&) { // a disk that is full for one file may be so for the next: the failure is told
        }
    };
    as_far_as_it_goes([&] { history_.flush(); });
    as_far_as_it_goes([&] { ledger_.flush(); });
    as_far_as_it_goes([&] { probes_.flush(); });
    as_far_as_it_goes([&] { finish(failure); });
}

void RunOutput::finish(std::string const& outcome)
{
    summary_.outcome = outcome;
    summary_.wall_time = seconds_since(run_begin_);
    write_summary(folder_, summary_);
}

} // namespace arenite
