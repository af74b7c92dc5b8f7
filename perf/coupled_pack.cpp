// SPDX-License-Identifier: MIT
#include "perf/coupled_pack.hpp"

#include "apps/bench_pack.hpp"

namespace arenite {
namespace {

FluidSettings fluid_of(std::array<int, 3> const& cells)
{
    FluidSettings settings;
    settings.cells = cells;
    settings.gravity = false;
    PatchSettings inlet, outlet;
    inlet.face = Face::y_lower;
    inlet.kind = PatchKind::velocity;
    inlet.velocity = {0, 1e-4, 0};
    outlet.face = Face::z_upper;
    outlet.kind = PatchKind::pressure;
    settings.patches = {inlet, outlet};
    return settings;
}

} // namespace

void make_coupled_pack(int grains, std::array<int, 3> const& cells, NormalLaw law, CoupledPack& pack)
{
    RunState& state = pack.state;
    BenchPack const lattice = lattice_pack(grains, cells); // cells are cubes, or nearly
    MaterialSettings const sand = bench_sand(60);
    state.particles = make_particles(lattice.grains, {sand.density});
    state.box.lower = lattice.lower;
    state.box.upper = lattice.upper;
    ContactSettings contact;
    contact.normal = law;
    if (law == NormalLaw::jkr) contact.break_point = BreakPoint::S;
    PairConstants pair = make_pair(sand, sand, contact);
    pair.bonds_at_start = law == NormalLaw::jkr;
    pack.planned.pairs = pack.planned.wall_pairs = {pair};
    pack.forces = make_stage_forces(pack.planned, -1, state);
    pack.step.dt = CoupledPack::grain_dt;
    pack.step.allowed_move = 1; // the list lasts: nothing moves far in the steps that are timed
    pack.search = {3e-5, pack.forces.needs, {}};
    pack.search.forces_follow = true; // as in a run
    search_contacts(state.particles, state.box, pack.search, state.contacts);
    if (pack.forces.form_bonds) pack.forces.form_bonds();
    FluidState& fluid = pack.fluid;
    FluidSettings const settings = fluid_of(cells);
    fluid.flow = make_flow(settings, Region{lattice.lower, lattice.upper}, true, {});
    fluid.boundary = make_boundary(settings, fluid.flow.grid);
    fluid.solver = make_flow_solver(settings, fluid.flow);
    fluid.exchange = make_exchange(fluid.flow, state.particles, settings, 1);
}

} // namespace arenite
