// SPDX-License-Identifier: MIT
// What the fluid and the exchange with it cost, measured in steps of the grains. Prints one CSV row; perf/fluid/run.py
// runs it.
//
//   bench_coupling GRAINS CELLS_X CELLS_Y CELLS_Z REPEATS
#include "apps/seconds_of.hpp"
#include "perf/coupled_pack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace arenite;

double median(std::vector<double> values)
{
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

void run(int grains, std::array<int, 3> const& cells, int repeats)
{
    CoupledPack pack;
    make_coupled_pack(grains, cells, NormalLaw::modified_jkr, pack);
    RunState& state = pack.state;
    FluidState& fluid = pack.fluid;
    std::vector<double> grain, deposit, flow, force;
    for (int n = 0; n <= repeats; ++n) { // the first warms up
        constexpr int steps = 10;
        double const steps_took = seconds_of([&] {
            for (int s = 0; s < steps; ++s) {
                pack.forces.evaluate_walls(pack.step.dt);
                for_each_pass(state.contacts, [&](ContactPass const& pass) {
                    pack.forces.evaluate_pass(pass, pack.step.dt);
                    kick_and_drift(state.integrator, pack.step, state.particles, state.contacts, {}, pass);
                });
            }
        });
        double const deposit_took = seconds_of([&] {
            deposit_porosity(fluid.flow, fluid.exchange, state.particles);
            deposit_drag(fluid.flow, fluid.exchange, state.particles, CoupledPack::fluid_dt);
        });
        double const flow_took =
            seconds_of([&] { advance_flow(fluid.flow, fluid.boundary, fluid.solver, CoupledPack::fluid_dt); });
        double const force_took =
            seconds_of([&] { evaluate_fluid_force(fluid.flow, fluid.solver, fluid.exchange, state.particles); });
        if (n == 0) continue;
        grain.push_back(steps_took / steps);
        deposit.push_back(deposit_took);
        flow.push_back(flow_took);
        force.push_back(force_took);
    }
    double const step = median(grain), exchange = median(deposit) + median(force), fluid_took = exchange + median(flow);
    auto const share = [&](int interval) { return fluid_took / (fluid_took + interval * step); };
    std::fputs(fmt::format("{},{}x{}x{},{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.3f},{:.4f},{:.4f}\n", state.particles.count,
                           cells[0], cells[1], cells[2], ExecutionSpace::name(), ExecutionSpace().concurrency(), 1e3 * step,
                           1e3 * median(deposit), 1e3 * median(force), 1e3 * median(flow), exchange / step, share(100),
                           share(50))
                   .c_str(),
               stdout);
}

} // namespace

int main(int argc, char** argv)
{
    Kokkos::ScopeGuard const kokkos(argc, argv);
    if (argc < 6) {
        std::fputs("bench_coupling GRAINS CELLS_X CELLS_Y CELLS_Z REPEATS\n", stderr);
        return 2;
    }
    run(std::atoi(argv[1]), {std::atoi(argv[2]), std::atoi(argv[3]), std::atoi(argv[4])}, std::atoi(argv[5]));
}
