// SPDX-License-Identifier: MIT
#include "apps/bench.hpp"

#include "apps/bench_pack.hpp"
#include "core/error.hpp"
#include "io/build_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

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
    bench->add_flag("--json", options.json, "one JSON line per result (as always)");
}

int run_bench(BenchOptions const& options)
{
    BenchPack const pack = options.pack.empty() ? lattice_pack(options.grains) : read_pack(options.pack);
    BenchSettings settings;
    settings.law = options.law == "jkr" ? NormalLaw::jkr : NormalLaw::hertz;
    settings.surface_energy = options.surface_energy;
    settings.gravity = options.pack.empty() ? 0 : options.gravity;
    settings.skin = options.skin;
    settings.warm_up = options.warm_up;
    settings.steps = options.steps;
    Hardware const machine = hardware();
    for (int repeat = 0; repeat < options.repeats; ++repeat) {
        BenchRun const run = run_pack(pack, settings);
        double const per = 1e9 / (static_cast<double>(run.grains) * static_cast<double>(run.steps));
        std::fputs(fmt::format("{{\"pack\": \"{}\", \"law\": \"{}\", \"grains\": {}, \"steps\": {}, \"particle_steps_per_s\": {:.6g}, "
                               "\"evaluate_ns\": {:.4g}, \"integrate_ns\": {:.4g}, \"search_ns\": {:.4g}, \"searches\": {}, "
                               "\"candidates_per_grain\": {:.4g}, \"contacts_per_grain\": {:.4g}, \"skin_m\": {:g}, \"backend\": \"{}\", "
                               "\"concurrency\": {}, \"state_hash\": \"{:016x}\", \"commit\": \"{}\"}}\n",
                               pack.name, options.law, run.grains, run.steps, run.particle_steps_per_second(), run.seconds_evaluate * per,
                               run.seconds_integrate * per, run.seconds_search * per, run.searches, run.candidates_per_grain,
                               run.contacts_per_grain, settings.skin, machine.backend, machine.concurrency, run.state_hash,
                               build_info().commit)
                       .c_str(),
                   stdout);
        std::fflush(stdout);
    }
    return 0;
}

} // namespace arenite
