// SPDX-License-Identifier: MIT
// What a run writes, and when: history, fields, checkpoints, the ledger, the summary.
#pragma once

#include "apps/probes.hpp"
#include "apps/run_state.hpp"
#include "apps/stage_plan.hpp"
#include "io/field_output.hpp"
#include "io/history.hpp"
#include "io/progress.hpp"
#include "io/summary.hpp"

#include <chrono>
#include <map>
#include <string>
#include <utility>

namespace arenite {

struct Look;
struct StageSetup;
class StageWatch;

/// Steps between two rows of the history, two states of the fields, two checkpoints; 0: none.
struct OutputCadence {
    std::int64_t history = 0, fields = 0, checkpoint = 0;

    static bool due(std::int64_t every, std::int64_t step) { return every > 0 && step % every == 0; }
    bool due(std::int64_t step) const { return due(history, step) || due(fields, step) || due(checkpoint, step); }
};

class RunOutput {
public:
    /// Reads what an earlier run left in the folder and writes nothing. Throws InputError if a resumed run cannot go on
    /// with its tables.
    RunOutput(std::filesystem::path folder, Scene const& scene, StagePlan const& plan,
              std::optional<ResumePoint> const& resume, int first_stage, bool quiet);

    /// From here on the folder is this run's: what an earlier one wrote beyond the point where this one goes on is dropped.
    void open();

    OutputCadence cadence(PlannedStage const& planned) const;

    void begin_stage(PlannedStage const& planned, RunState const& state);
    void write_start(RunState& state, Look const& look);
    /// History and fields if this step is due (or the stage ended), and the progress line.
    void write_due(StageSetup const& setup, RunState& state, StageWatch& watch, bool ended);
    void write_fields(RunState& state);
    void end_stage(StageSetup const& setup, RunState& state, StageWatch& watch, std::string const& ended_by);

    bool checkpoint_is_due(RunState const& state) const;
    void write_checkpoint(RunState& state, bool stage_end);

    /// One row of the ledger; returns the grain's mass, kg.
    Real mass_of(Grain const& grain) const; // kg
    void write_produced(Grain const& grain, RunState const& state);

    /// Counts a warning of a kind; prints the first ones in a stage of the scene, whatever parts it is run in. The end of a
    /// part is the start of the next one: what was said of it is not said again.
    void warn(std::string const& kind, std::string const& message);
    void say(std::string const& message);

    /// Writes summary.json with how the run ended.
    void finish(std::string const& outcome);
    /// The tables and the summary of a run that something ended, as far as they can be written. Throws nothing.
    void finish_after(std::string const& failure);

private:
    void write_history(RunState& state, Look const& look);
    void fluid_warnings(RunState const& state);
    void warn_of_little_space(RunState const& state);
    void flush_tables();
    StageSummary& stage() { return summary_.stages.back(); }

    std::filesystem::path folder_;
    std::optional<ResumePoint> resume_;
    Scene const& scene_;
    StagePlan const& plan_;
    History history_;
    ProducedLedger ledger_;
    Probes probes_;
    std::optional<FieldOutput> fields_; // once open
    Progress progress_;
    RunSummary summary_;
    PlannedStage const* planned_ = nullptr;
    OutputCadence cadence_;
    std::chrono::steady_clock::time_point run_begin_, stage_begin_;
    std::int64_t counted_step_ = 0, last_fields_step_ = -1;
    std::map<std::pair<int, std::string>, std::int64_t> warnings_; // [stage of the scene, kind] how many
    std::map<std::string, std::string> last_warning_;              // [kind]
    bool quiet_;
};

} // namespace arenite
