// SPDX-License-Identifier: MIT
#include "apps/stage_loop.hpp"

#include "apps/make_state.hpp"
#include "apps/sample.hpp"
#include "apps/stage_setup.hpp"
#include "apps/stage_watch.hpp"
#include "apps/stop_signal.hpp"
#include "core/coarse_graining.hpp"
#include "core/wall_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace arenite {
namespace {

Cadence make_cadence(PlannedStage const& planned, StageWatch const& watch, Until const& until, Clock clock,
                     RunOutput const& output)
{
    Cadence cadence{planned.coupling_interval, watch.last_step(), 0, output.cadence(planned)};
    if (!until.time || !(planned.dt > 0)) return cadence;
    Real const steps = std::ceil((*until.time - clock.stage_start) / planned.dt) - 2; // and the first step that is there
    if (!(steps < Real(1e15))) return cadence;
    for (clock.stage_step = std::max<std::int64_t>(1, static_cast<std::int64_t>(steps)); !until.reached(clock.time());)
        ++clock.stage_step;
    cadence.until = clock.stage_step;
    return cadence;
}

} // namespace

void advance_fluid(FluidState& fluid, Particles& particles, Real fluid_dt)
{
    Phase const phase("fluid step");
    bool const coupled = fluid.flow.has_drag(); // stays so when the last grain has left
    if (coupled) {
        deposit_porosity(fluid.flow, fluid.exchange, particles);
        deposit_drag(fluid.flow, fluid.exchange, particles, fluid_dt);
    }
    fluid.report = advance_flow(fluid.flow, fluid.boundary, fluid.solver, fluid_dt);
    if (coupled) evaluate_fluid_force(fluid.flow, fluid.solver, fluid.exchange, particles);
}

namespace {

/// What makes the coupling inaccurate, said once a stage.
void warn_of_coupling(FluidState const& fluid, Particles const& particles, RunOutput& output)
{
    if (!fluid.flow.has_drag() || particles.count == 0) return;
    for (std::string const& message : check_exchange(fluid.exchange, particles)) output.warn("coupling", message);
}

void warn_of_fast_walls(StageSetup const& setup, RunState const& state, RunOutput& output)
{
    std::string const message = tunnelling_walls(state.walls, smallest_grain_diameter(state.particles) / 2, setup.step.dt);
    if (!message.empty()) output.warn("fast_wall", message);
}

/// Names that mean nothing in this run; said once, when its grains are there.
void warn_of_the_absent(Scene const& scene, RunState const& state, RunOutput& output)
{
    for (std::size_t g = 0; g < scene.groups.size(); ++g)
        if (state.groups.members.size() > g && state.groups.members[g].empty())
            output.warn("empty_group", fmt::format("group {} has no grain", scene.groups[g].name));
    auto const id = Kokkos::create_mirror_view_and_copy(HostSpace(), state.particles.id);
    for (ProbeSettings const& probe : scene.output.probes) {
        bool found = !probe.grain;
        for (int i = 0; i < state.particles.count && !found; ++i) found = id(i) == *probe.grain;
        if (!found) output.warn("probe", fmt::format("probe {}: there is no grain {}", probe.name, *probe.grain));
    }
    if (scene.particles.source != ParticleSource::distribution) return;
    std::vector<SizeClass> const classes =
        make_size_classes(scene.particles.distribution, scene.coarse_graining, volume_of(generation_region(scene)));
    for (std::size_t c = 0; c < classes.size(); ++c)
        if (classes[c].count == 0 && scene.particles.distribution.fractions[c] > 0)
            output.warn("empty_class",
                        fmt::format("class {} ({:g} m): its share of the grains is less than one: it has none", c,
                                    classes[c].diameter));
}

/// From one moment at which somebody looks to the next.
void advance_grains(StageSetup& setup, Cadence const& cadence, RunState& state)
{
    StepSettings const& step = setup.step;
    drift(state.integrator, step, state.particles, state.contacts);
    for (;;) {
        Phase const phase("grain step");
        follow_drift(setup, state, cadence.stops_at(state.clock.stage_step + 1));
        setup.forces.evaluate_walls(step.dt);
        drive_servos(setup, state);
        WallForceRows const wall_rows = force_rows(state.wall_contacts);
        if (cadence.stops_at(state.clock.stage_step)) {
            setup.forces.evaluate_pass(whole_step(state.contacts), step.dt);
            kick(state.integrator, step, state.particles, state.contacts, wall_rows);
            return;
        }
        for_each_pass(state.contacts, [&](ContactPass const& pass) {
            setup.forces.evaluate_pass(pass, step.dt);
            kick_and_drift(state.integrator, step, state.particles, state.contacts, wall_rows, pass);
        });
    }
}

/// A balance is kept: kick and drift are apart, since forces and velocities of every step are looked at.
void advance_grains_in_balance(StageSetup& setup, Cadence const& cadence, RunState& state)
{
    StepSettings const& step = setup.step;
    for (;;) {
        Phase const phase("grain step");
        drift(state.integrator, step, state.particles, state.contacts);
        follow_drift(setup, state, cadence.stops_at(state.clock.stage_step + 1));
        begin_step(setup, state);
        evaluate_all(setup.forces, state, step.dt);
        kick(state.integrator, step, state.particles, state.contacts, force_rows(state.wall_contacts));
        add_step(setup, state);
        drive_servos(setup, state);
        if (cadence.stops_at(state.clock.stage_step)) return;
    }
}

} // namespace

void advance(StageSetup& setup, Cadence const& cadence, RunState& state)
{
    if (state.energy) advance_grains_in_balance(setup, cadence, state);
    else advance_grains(setup, cadence, state);
}

std::string run_stage(Scene const& scene, PlannedStage const& planned, Until const& until, RunState& state,
                      RunOutput& output)
{
    Phase const phase(planned.label);
    bool const resumes = state.clock.stage_step > 0;
    StageSetup setup = resumes ? resume_stage(scene, planned, state) : begin_stage(scene, planned, state);
    if (planned.settings.kind == StageKind::generation) return "grains placed";
    if (scene.output.energies) {
        if (resumes && state.energy) take_up_account(setup, state);
        else open_account(setup, state);
    }

    StageWatch watch(scene, planned);
    Cadence const cadence = make_cadence(planned, watch, until, state.clock, output);
    output.begin_stage(planned, state);
    warn_of_fast_walls(setup, state, output);
    if (state.clock.step == 0) warn_of_the_absent(scene, state, output);
    if (!resumes) output.write_start(state, watch.look(setup, state));
    for (bool first = true;; first = false) {
        std::int64_t const step = state.clock.stage_step;
        if (!(first && resumes)) {
            std::optional<std::string> ended;
            if (cadence.checks_at(step)) ended = watch.has_ended(setup, state);
            if (!first) {
                if (cadence.checks_at(step) && remove_departed(setup, state, output)) watch.forget_look();
                output.write_due(setup, state, watch, ended.has_value());
            }
            if (ended) {
                output.end_stage(setup, state, watch, *ended);
                return *ended;
            }
            if (!first && output.checkpoint_is_due(state)) output.write_checkpoint(state, false);
            if (step == cadence.until)
                output.write_fields(state); // no row of the history: the table is that of a run without a stop
        }
        bool const past_until = cadence.until > 0 && step >= cadence.until;
        if (!first && (past_until || stop_signal() != 0)) {
            StageRecord const record = state.record;
            output.end_stage(setup, state, watch, "stopped");
            state.record = record; // it looked where a run without a stop does not
            return "stopped";
        }
        if (cadence.fluid > 0 && state.clock.stage_step % cadence.fluid == 0) {
            advance_fluid(*state.fluid, state.particles, cadence.fluid * planned.dt);
            if (first) warn_of_coupling(*state.fluid, state.particles, output);
        }
        advance(setup, cadence, state);
        watch.check_health(setup, state);
    }
}

} // namespace arenite
