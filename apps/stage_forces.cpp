// SPDX-License-Identifier: MIT
#include "apps/stage_forces.hpp"

#include "kernels/contact/contact_laws.hpp"
#include "kernels/contact_search.hpp"
#include "kernels/evaluate_forces.hpp"

#include <algorithm>

namespace arenite {
namespace {

template <class Law> auto pair_terms(Law const& law, RunState& state, View1<std::uint8_t> const& adhered)
{
    Particles const& p = state.particles;
    return PairPower<Law>{law.pairs, state.contacts, p.position, p.velocity, p.spin, p.material, adhered, state.box};
}

template <class Law> auto wall_terms(Law const& law, RunState& state, View1<std::uint8_t> const& adhered, Vec3 const& origin)
{
    Particles const& p = state.particles;
    return WallPower<Law>{law.pairs, state.wall_contacts, state.walls.views, p.position, p.velocity,
                          p.spin,    p.material,          adhered,           state.box,  origin};
}

template <class Law> Terms<3> pair_energies(Law const& law, RunState& state)
{
    Particles const& p = state.particles;
    return reproducible_sums<3>(state.sums, "pair_energy", state.contacts.count,
                                PairEnergy<Law>{{law.pairs, state.contacts, p.position, p.material, state.box}});
}

template <class Law> Terms<4> wall_energies(Law const& law, RunState& state)
{
    Particles const& p = state.particles;
    return reproducible_sums<4>(
        state.sums, "wall_energy", state.wall_contacts.count,
        WallEnergy<Law>{law.pairs, state.wall_contacts, state.walls.views, p.position, p.velocity, p.material});
}

void bind_balance(AnyContactLaw const& law, AnyContactLaw const& wall_law, RunState& state, StageForces& forces)
{
    forces.sum_pair_power = [&state, law](Real* to, View1<std::uint8_t> const& adhered) {
        std::visit(
            [&](auto const& l) {
                reproducible_sums_to<contact_power_terms>(to, state.sums, "pair_power", blocks_of(state.contacts),
                                                          pair_terms(l, state, adhered));
            },
            law);
    };
    forces.sum_wall_power = [&state, wall_law](Real* to, View1<std::uint8_t> const& adhered, Vec3 const& origin) {
        std::visit(
            [&](auto const& l) {
                reproducible_sums_to<contact_power_terms>(to, state.sums, "wall_power", state.wall_contacts.count,
                                                          wall_terms(l, state, adhered, origin));
            },
            wall_law);
    };
    forces.sum_wall_work = [&state](Real* to) {
        reproducible_sums_to<1>(to, state.sums, "wall_work", state.wall_contacts.count,
                                WallWork{state.wall_contacts, state.walls.views, state.particles.position});
    };
    forces.stored = [&state, law, wall_law] {
        Terms<3> const pairs = std::visit([&](auto const& l) { return pair_energies(l, state); }, law);
        Terms<4> const walls = std::visit([&](auto const& l) { return wall_energies(l, state); }, wall_law);
        return StoredEnergy{pairs[0] + walls[0], pairs[1] + walls[1], pairs[2] + walls[2]};
    };
}

bool any_bonds_at_start(std::vector<PairConstants> const& pairs)
{
    return std::any_of(pairs.begin(), pairs.end(), [](PairConstants const& pair) { return pair.bonds_at_start; });
}

} // namespace

StageForces make_stage_forces(PlannedStage const& planned, Real friction, RunState& state)
{
    std::vector<PairConstants> pairs = planned.pairs;
    if (friction >= 0)
        for (PairConstants& pair : pairs) pair.friction = friction;
    int const material = shared_material(state.particles);
    AnyContactLaw const law = make_contact_law(pairs, material), wall_law = make_contact_law(planned.wall_pairs, material);

    StageForces forces;
    forces.needs = contact_needs(law, pairs, planned.keeps_balance);
    forces.wall_needs = contact_needs(wall_law, planned.wall_pairs);
    forces.evaluate_pass = [&state, law](ContactPass const& pass, Real dt) {
        evaluate_contacts(law, state.particles, state.box, state.contacts, pass, dt, state.integrator.gate());
    };
    forces.evaluate_walls = [&state, wall_law](Real dt) {
        evaluate_wall_contacts(wall_law, state.particles, state.box, state.walls, state.wall_contacts, dt,
                               state.integrator.gate());
    };
    bool const grains_bond = any_bonds_at_start(pairs), walls_bond = any_bonds_at_start(planned.wall_pairs);
    if (grains_bond || walls_bond)
        forces.form_bonds = [&state, law, wall_law, grains_bond, walls_bond] {
            if (grains_bond) form_bonds(state.particles, state.box, state.contacts, pair_table(law));
            if (walls_bond) form_wall_bonds(state.particles, state.walls, state.wall_contacts, pair_table(wall_law));
        };
    forces.report = std::visit(
        [&state](auto const& l) -> std::function<ContactReport()> {
            return [&state, l] { return report_contacts(l, state.particles, state.box, state.contacts, state.sums); };
        },
        law);
    forces.wall_elastic = [&state, wall_law] {
        return std::visit([&](auto const& l) { return wall_energies(l, state)[3]; }, wall_law);
    };
    bind_balance(law, wall_law, state, forces);
    return forces;
}

} // namespace arenite
