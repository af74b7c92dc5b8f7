// SPDX-License-Identifier: MIT
#include "apps/bench.hpp"

#include "apps/bench_limits.hpp"
#include "apps/bench_pack.hpp"
#include "io/build_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace arenite {

void add_bench(CLI::App& app, BenchOptions& options)
{
    CLI::App* bench = app.add_subcommand("bench", "particle-steps/s of a pack and a law, one JSON line per result");
    bench->add_option("--pack", options.pack, "text file of x y z radius lines (m); a lattice that is made unless named");
    bench->add_option("--grains", options.grains, "of the lattice")->check(CLI::PositiveNumber);
    bench->add_option("--law", options.law, "hertz or jkr")->check(CLI::IsMember({"hertz", "jkr"}));
    bench->add_option("--steps", options.steps, "timed")->check(CLI::PositiveNumber);
    bench->add_option("--warm-up", options.warm_up, "steps before them")->check(CLI::NonNegativeNumber);
    bench->add_option("--repeats", options.repeats, "results")->check(CLI::PositiveNumber);
    bench->add_option("--skin", options.skin, "m")->check(CLI::PositiveNumber);
    bench->add_option("--gravity", options.gravity, "m/s2");
    bench->add_option("--surface-energy", options.surface_energy, "J/m2, for jkr");
    bench->add_option("--tile", options.tiles, "copies of the pack along x and y, mirrored in turn")
        ->expected(2)
        ->check(CLI::PositiveNumber);
    bench->add_option("--relax", options.relax, "steps under damping before all others, for a pack that was tiled")
        ->check(CLI::NonNegativeNumber);
    bench->add_option("--save", options.save, "text file to write the pack to that is measured");
    bench->add_flag("--whole-steps", options.whole_steps,
                    "a step evaluates all contacts before it moves a grain, also of packs that are stepped tile by tile");
    bench->add_flag("--limits", options.limits,
                    "measure a stream copy and multiply-adds too: the shares of them that are reached");
    bench->add_flag("--json", options.json, "one JSON line per result (as always)");
}

namespace {

using Fields = std::vector<std::pair<std::string, std::string>>; // name, value as JSON writes it

std::string number(double value) { return fmt::format("{:.6g}", value); }
std::string quoted(std::string const& text) { return "\"" + text + "\""; }

std::string json(Fields const& fields)
{
    std::string text;
    for (auto const& [name, value] : fields) text += fmt::format("{}\"{}\": {}", text.empty() ? "" : ", ", name, value);
    return "{" + text + "}";
}

BenchPack pack_of(BenchOptions const& options, BenchSettings const& settings)
{
    BenchPack pack = options.pack.empty() ? lattice_pack(options.grains) : read_pack(options.pack);
    if (!options.tiles.empty()) pack = tiled_pack(pack, options.tiles[0], options.tiles[1]);
    if (options.relax > 0) pack = relaxed_pack(pack, settings, options.relax);
    if (!options.save.empty()) write_pack(pack, options.save);
    return pack;
}

void add_speed(BenchRun const& run, Fields& fields)
{
    double const per = 1e9 / (static_cast<double>(run.grains) * static_cast<double>(run.steps));
    fields.insert(fields.end(), {{"grains", std::to_string(run.grains)},
                                 {"steps", std::to_string(run.steps)},
                                 {"tile_grains", std::to_string(run.tile_grains)},
                                 {"particle_steps_per_s", number(run.particle_steps_per_second())},
                                 {"evaluate_ns", number(run.seconds_evaluate * per)},
                                 {"integrate_ns", number(run.seconds_integrate * per)},
                                 {"search_ns", number(run.seconds_search * per)},
                                 {"searches", std::to_string(run.searches)},
                                 {"one_search_s", number(run.one_search)},
                                 {"candidates_per_grain", number(run.candidates_per_grain)},
                                 {"contacts_per_grain", number(run.contacts_per_grain)}});
}

double memory_of(BenchRun const& run)
{
    double bytes = 0;
    for (auto const& part : run.memory) bytes += part.second;
    return bytes;
}

/// What the pack's memory is made of: bytes a grain by View, the large ones first.
void add_memory(BenchRun const& run, Fields& fields)
{
    std::vector<std::pair<std::string, double>> parts(run.memory.begin(), run.memory.end());
    std::stable_sort(parts.begin(), parts.end(), [](auto const& a, auto const& b) { return a.second > b.second; });
    Fields views;
    for (auto const& [label, bytes] : parts) views.emplace_back(label, number(bytes / run.grains));
    fields.insert(fields.end(), {{"memory_bytes_per_grain", number(memory_of(run) / run.grains)},
                                 {"peak_memory_bytes_per_grain", number(run.peak_memory / run.grains)},
                                 {"memory", json(views)}});
}

/// The step's cost and, where asked for, the shares of the machine's limits that it reaches.
void add_roofline(BenchRun const& run, NormalLaw law, bool limits, Fields& fields)
{
    StepCost const cost =
        step_cost(law, {run.contacts_per_grain, run.candidates_per_grain, run.gathered_per_grain, run.shared_per_grain});
    fields.emplace_back("bytes_per_particle_step", number(cost.bytes));
    fields.emplace_back("flops_per_particle_step", number(cost.flops));
    if (!limits) return;
    constexpr double beyond_caches = 1 << 29; // bytes
    double const speed = run.particle_steps_per_second();
    double const near = copy_bandwidth(memory_of(run)), far = copy_bandwidth(beyond_caches), flops = multiply_add_rate();
    fields.insert(fields.end(), {{"copy_bytes_per_s", number(near)}, // within as much memory as the pack takes
                                 {"copy_bytes_per_s_beyond_caches", number(far)},
                                 {"multiply_add_flops_per_s", number(flops)},
                                 {"share_of_copy", number(cost.bytes * speed / near)},
                                 {"share_of_copy_beyond_caches", number(cost.bytes * speed / far)},
                                 {"share_of_multiply_add", number(cost.flops * speed / flops)}});
}

} // namespace

int run_bench(BenchOptions const& options)
{
    BenchSettings settings;
    settings.law = options.law == "jkr" ? NormalLaw::jkr : NormalLaw::hertz;
    settings.surface_energy = options.surface_energy;
    settings.gravity = options.pack.empty() ? 0 : options.gravity;
    settings.skin = options.skin;
    settings.warm_up = options.warm_up;
    settings.steps = options.steps;
    settings.whole_steps = options.whole_steps;
    BenchPack const pack = pack_of(options, settings);
    Hardware const machine = hardware();
    for (int repeat = 0; repeat < options.repeats; ++repeat) {
        BenchRun const run = run_pack(pack, settings);
        Fields fields{{"pack", quoted(pack.name)}, {"law", quoted(options.law)}};
        add_speed(run, fields);
        add_roofline(run, settings.law, options.limits, fields);
        add_memory(run, fields);
        fields.insert(fields.end(), {{"skin_m", number(settings.skin)},
                                     {"backend", quoted(machine.backend)},
                                     {"concurrency", std::to_string(machine.concurrency)},
                                     {"state_hash", fmt::format("\"{:016x}\"", run.state_hash)},
                                     {"commit", quoted(build_info().commit)}});
        std::fputs((json(fields) + "\n").c_str(), stdout);
        std::fflush(stdout);
    }
    return 0;
}

} // namespace arenite
