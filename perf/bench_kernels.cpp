// SPDX-License-Identifier: MIT
// Every kernel of the step by itself, on 33 000 grains (bonded, history on) and on 64^3 cells. Items are grains, or
// cells.
#include "fluid/pressure.hpp"
#include "perf/coupled_pack.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace arenite;

/// Makes a pack that is empty, and takes its fluid through a step.
CoupledPack& ready(CoupledPack& pack, int grains, std::array<int, 3> const& cells, NormalLaw law)
{
    if (pack.state.particles.count > 0) return pack;
    make_coupled_pack(grains, cells, law, pack);
    deposit_porosity(pack.fluid.flow, pack.fluid.exchange, pack.state.particles);
    deposit_drag(pack.fluid.flow, pack.fluid.exchange, pack.state.particles, CoupledPack::fluid_dt);
    advance_flow(pack.fluid.flow, pack.fluid.boundary, pack.fluid.solver, CoupledPack::fluid_dt);
    return pack;
}

/// One pack per law and grid, kept past main: Views end with Kokkos, not after it.
CoupledPack& pack_of(NormalLaw law)
{
    static CoupledPack* const packs[2] = {new CoupledPack, new CoupledPack};
    return ready(*packs[law == NormalLaw::hertz], 32768, {12, 12, 6}, law);
}

/// A fine grid on a small pack: the kernels of the fluid.
CoupledPack& fluid_pack()
{
    static CoupledPack* const pack = new CoupledPack;
    return ready(*pack, 4096, {64, 64, 64}, NormalLaw::hertz);
}

template <class Work> void repeat(benchmark::State& state, int items, Work const& work)
{
    for (auto _ : state) {
        work();
        Kokkos::fence();
    }
    state.SetItemsProcessed(state.iterations() * items);
}

template <NormalLaw law> void evaluate_contacts(benchmark::State& state)
{
    CoupledPack& pack = pack_of(law);
    repeat(state, pack.state.particles.count, [&] { evaluate_all(pack.forces, pack.state, pack.step.dt); });
}

void kick_and_drift(benchmark::State& state)
{
    CoupledPack& pack = pack_of(NormalLaw::modified_jkr);
    StepSettings still = pack.step; // the same work, and the pack stays as it is however often it is done
    still.dt = 0;
    RunState& run = pack.state;
    repeat(state, run.particles.count, [&] { kick_and_drift(run.integrator, still, run.particles, run.contacts, {}); });
}

void contact_search(benchmark::State& state)
{
    CoupledPack& pack = pack_of(NormalLaw::modified_jkr);
    RunState& run = pack.state;
    repeat(state, run.particles.count, [&] { search_contacts(run.particles, run.box, pack.search, run.contacts); });
}

void deposit(benchmark::State& state)
{
    CoupledPack& pack = pack_of(NormalLaw::modified_jkr);
    repeat(state, pack.state.particles.count, [&] {
        deposit_porosity(pack.fluid.flow, pack.fluid.exchange, pack.state.particles);
        deposit_drag(pack.fluid.flow, pack.fluid.exchange, pack.state.particles, CoupledPack::fluid_dt);
    });
}

void drag_to_grains(benchmark::State& state)
{
    CoupledPack& pack = pack_of(NormalLaw::modified_jkr);
    FluidState& fluid = pack.fluid;
    repeat(state, pack.state.particles.count,
           [&] { evaluate_fluid_force(fluid.flow, fluid.solver, fluid.exchange, pack.state.particles); });
}

void multigrid(benchmark::State& state)
{
    FlowSolver& solver = fluid_pack().fluid.solver;
    repeat(state, fluid_pack().fluid.flow.grid.cell_count(),
           [&] { multigrid_cycle(solver.levels, solver.pressure_system.residual, solver.pressure_system.preconditioned); });
}

void fluid_step(benchmark::State& state)
{
    FluidState& fluid = fluid_pack().fluid;
    repeat(state, fluid.flow.grid.cell_count(),
           [&] { advance_flow(fluid.flow, fluid.boundary, fluid.solver, CoupledPack::fluid_dt); });
}

void pressure_solve(benchmark::State& state)
{
    FluidState& fluid = fluid_pack().fluid;
    TimeDerivative const time = time_derivative(fluid.solver, CoupledPack::fluid_dt);
    repeat(state, fluid.flow.grid.cell_count(), [&] { solve_pressure(fluid.flow, fluid.boundary, fluid.solver, time); });
}

} // namespace

int main(int argc, char** argv)
{
    Kokkos::ScopeGuard const kokkos(argc, argv);
    benchmark::Initialize(&argc, argv);
    struct Named {
        char const* name;
        void (*run)(benchmark::State&);
    };
    for (Named const& bench : {Named{"evaluate_contacts, Hertz", evaluate_contacts<NormalLaw::hertz>},
                               {"evaluate_contacts, modified JKR", evaluate_contacts<NormalLaw::modified_jkr>},
                               {"kick_and_drift", kick_and_drift},
                               {"contact search", contact_search},
                               {"deposit", deposit},
                               {"drag to grains", drag_to_grains},
                               {"multigrid cycle", multigrid},
                               {"fluid step", fluid_step},
                               {"pressure solve", pressure_solve}})
        benchmark::RegisterBenchmark(bench.name, bench.run)->UseRealTime()->Unit(benchmark::kMillisecond);
    benchmark::RunSpecifiedBenchmarks();
}
