// SPDX-License-Identifier: MIT
#include "apps/stage_loop.hpp"

#include "apps/make_state.hpp"
#include "apps/stage_setup.hpp"
#include "apps/stage_watch.hpp"
#include "core/wall_motion.hpp"

namespace arenite {
namespace {

/// Velocities stand at the time of the positions only where somebody looks; in between kick and drift are one kernel.
struct Cadence {
    int fluid = 0, production = 0, check = 0;
    OutputCadence output;

    bool stops_at(std::int64_t step) const
    {
        return (fluid > 0 && step % fluid == 0) || step % production == 0 || step % check == 0 || output.due(step);
    }
};

Cadence make_cadence(PlannedStage const& planned, RunOutput const& output)
{
    constexpr int production_interval = 100, check_interval = 100; // steps
    return {planned.coupling_interval, production_interval, check_interval, output.cadence(planned)};
}

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

/// From one moment at which somebody looks to the next.
void advance_grains(StageSetup& setup, Cadence const& cadence, RunState& state)
{
    StepSettings const& step = setup.step;
    drift(state.integrator, step, state.particles, state.contacts);
    for (;;) {
        Phase const phase("grain step");
        follow_drift(setup, state, cadence.stops_at(state.clock.stage_step + 1));
        setup.forces.evaluate(step.dt);
        drive_servos(setup, state);
        WallForceRows const wall_rows = force_rows(state.wall_contacts);
        if (cadence.stops_at(state.clock.stage_step)) {
            kick(state.integrator, step, state.particles, state.contacts, wall_rows);
            return;
        }
        kick_and_drift(state.integrator, step, state.particles, state.contacts, wall_rows);
    }
}

/// The same, and a balance is kept: kick and drift are apart, since forces and velocities of every step are looked at.
void advance_grains_in_balance(StageSetup& setup, Cadence const& cadence, RunState& state)
{
    StepSettings const& step = setup.step;
    for (;;) {
        Phase const phase("grain step");
        drift(state.integrator, step, state.particles, state.contacts);
        follow_drift(setup, state, true);
        begin_step(setup, state);
        setup.forces.evaluate(step.dt);
        kick(state.integrator, step, state.particles, state.contacts, force_rows(state.wall_contacts));
        add_step(setup, state);
        drive_servos(setup, state);
        if (cadence.stops_at(state.clock.stage_step)) return;
    }
}

} // namespace

std::string run_stage(Scene const& scene, PlannedStage const& planned, Until const& until, RunState& state,
                      RunOutput& output)
{
    Phase const phase(planned.label);
    bool const resumes = state.clock.stage_step > 0;
    StageSetup setup = resumes ? resume_stage(scene, planned, state) : begin_stage(scene, planned, state);
    if (planned.settings.kind == StageKind::generation) return "grains placed";
    if (scene.output.energies && !(resumes && state.energy)) open_account(setup, state);

    Cadence const cadence = make_cadence(planned, output);
    StageWatch watch(scene, planned, until);
    output.begin_stage(planned, state);
    warn_of_fast_walls(setup, state, output);
    if (!resumes) output.write_start(state, watch.look(setup, state));
    for (bool first = true;; first = false) {
        if (!(first && resumes)) {
            std::optional<std::string> const ended = watch.has_ended(setup, state);
            if (!first) {
                output.write_due(setup, state, watch, ended.has_value());
                if (remove_departed(setup, state, output) || output.checkpoint_is_due(state)) search(setup, state);
                if (!ended && output.checkpoint_is_due(state)) output.write_checkpoint(state, false);
            }
            if (ended) {
                output.end_stage(setup, state, watch, *ended);
                return *ended;
            }
        }
        if (cadence.fluid > 0 && state.clock.stage_step % cadence.fluid == 0) {
            advance_fluid(*state.fluid, state.particles, cadence.fluid * planned.dt);
            if (first) warn_of_coupling(*state.fluid, state.particles, output);
        }
        if (state.energy) advance_grains_in_balance(setup, cadence, state);
        else advance_grains(setup, cadence, state);
        watch.check_health(setup, state);
    }
}

} // namespace arenite
