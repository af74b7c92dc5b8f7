// SPDX-License-Identifier: MIT
#include "apps/verify/grain_system.hpp"

#include "core/error.hpp"
#include "kernels/evaluate_forces.hpp"

#include <algorithm>
#include <cstring>
#include <tuple>

namespace arenite {
namespace {

std::vector<PairConstants> all_pairs(SystemSettings const& settings)
{
    std::vector<PairConstants> pairs;
    for (MaterialSettings const& a : settings.materials)
        for (MaterialSettings const& b : settings.materials) {
            pairs.push_back(make_pair(a, b, settings.contact));
            pairs.back().bonds_at_start = settings.start_bonded && pairs.back().surface_energy > 0;
        }
    return pairs;
}

StepSettings step_settings(SystemSettings const& settings)
{
    StepSettings step;
    step.dt = settings.dt;
    step.gravity = settings.gravity;
    step.strain_rate = settings.box.strain_rate;
    step.strain_origin = settings.box.lower;
    step.allowed_move = settings.skin / 2;
    return step;
}

void deform_box(GrainSystem& system)
{
    PeriodicBox& box = system.settings.box;
    Vec3 const size = box.size();
    for (int axis = 0; axis < 3; ++axis) box.upper[axis] += system.settings.dt * box.strain_rate[axis] * size[axis];
}

void search(GrainSystem& system, bool forces_follow)
{
    SearchSettings search;
    search.skin = system.settings.skin;
    search.needs = contact_needs(system.law, system.pairs);
    search.tile_grains = system.settings.tile_grains;
    search.forces_follow = forces_follow;
    search_contacts(system.particles, system.settings.box, search, system.contacts);
    ++system.rebuilds;
}

} // namespace

void rebuild(GrainSystem& system) { search(system, false); }

void evaluate(GrainSystem& system, ContactPass const& pass)
{
    evaluate_contacts(system.law, system.particles, system.settings.box, system.contacts, pass, system.settings.dt,
                      system.integrator.gate());
}

void evaluate(GrainSystem& system) { evaluate(system, whole_step(system.contacts)); }

GrainSystem make_system(SystemSettings const& settings)
{
    GrainSystem system;
    system.settings = settings;
    system.pairs = all_pairs(settings);
    system.law = make_contact_law(system.pairs);
    std::vector<Real> densities;
    for (MaterialSettings const& material : settings.materials) densities.push_back(material.density);
    system.particles = make_particles(settings.grains, densities);
    search(system, true);
    if (settings.start_bonded) form_bonds(system.particles, settings.box, system.contacts, pair_table(system.law));
    // The forces at the start: no time has passed, so springs stay as they are.
    Real const dt = system.settings.dt;
    system.settings.dt = 0;
    evaluate(system);
    kick(system.integrator, step_settings(system.settings), system.particles, system.contacts, {});
    system.settings.dt = dt;
    return system;
}

void advance(GrainSystem& system, int steps)
{
    StepSettings step = step_settings(system.settings);
    bool const fused = system.settings.fused;
    for (int n = 0; n < steps; ++n) {
        if (!fused || n == 0) drift(system.integrator, step, system.particles, system.contacts);
        deform_box(system);
        ++system.steps;
        int const interval = system.settings.rebuild_interval;
        bool const stale = take_stale(system.integrator) >= 0;
        if (stale || (interval > 0 && system.steps % interval == 0)) search(system, true);
        if (!fused || n == steps - 1) {
            evaluate(system);
            kick(system.integrator, step, system.particles, system.contacts, {});
        } else
            for_each_pass(system.contacts, [&](ContactPass const& pass) {
                evaluate(system, pass);
                kick_and_drift(system.integrator, step, system.particles, system.contacts, {}, pass);
            });
    }
}

std::vector<Grain> grains_by_id(GrainSystem const& system)
{
    std::vector<Grain> grains = download(system.particles);
    std::sort(grains.begin(), grains.end(), [](Grain const& a, Grain const& b) { return a.id < b.id; });
    return grains;
}

void place(GrainSystem& system, GrainId id, Vec3 const& position, Vec3 const& velocity, Vec3 const& spin)
{
    Particles const& grains = system.particles;
    auto const ids = Kokkos::create_mirror_view_and_copy(HostSpace(), grains.id);
    int row = 0;
    while (row < grains.count && ids(row) != id) ++row;
    ARENITE_REQUIRE(row < grains.count, "there is no such grain");
    auto const write = [&](RecordView const& records, Vec3 const& value) {
        auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), records);
        set_vector(host, row, value);
        Kokkos::deep_copy(records, host);
    };
    write(grains.position, position);
    write(grains.velocity, velocity);
    write(grains.spin, spin);
}

Vec3 force_on(GrainSystem const& system, GrainId id)
{
    auto const ids = Kokkos::create_mirror_view_and_copy(HostSpace(), system.particles.id);
    auto const force = Kokkos::create_mirror_view_and_copy(HostSpace(), system.particles.force);
    for (int row = 0; row < system.particles.count; ++row)
        if (ids(row) == id) return vector_of(force, row);
    return {};
}

Totals totals(GrainSystem const& system)
{
    Totals sum;
    auto const velocity = Kokkos::create_mirror_view_and_copy(HostSpace(), system.particles.velocity);
    auto const spin = Kokkos::create_mirror_view_and_copy(HostSpace(), system.particles.spin);
    auto const position = Kokkos::create_mirror_view_and_copy(HostSpace(), system.particles.position);
    for (int row = 0; row < system.particles.count; ++row) {
        Vec3 const v = vector_of(velocity, row), w = vector_of(spin, row), p = velocity(row, 3) * v;
        Vec3 const orbital = cross(vector_of(position, row), p), own = spin(row, 3) * w;
        sum.momentum += p;
        sum.angular_momentum += orbital + own;
        sum.momentum_scale += norm(p);
        sum.angular_scale += norm(orbital) + norm(own);
        sum.kinetic_energy += Real(0.5) * (dot(p, v) + dot(own, w));
    }
    return sum;
}

std::vector<ListedPair> listed_pairs(GrainSystem const& system)
{
    ContactList const& list = system.contacts;
    auto const id = Kokkos::create_mirror_view_and_copy(HostSpace(), system.particles.id);
    auto const first = Kokkos::create_mirror_view_and_copy(HostSpace(), list.first);
    auto const second = Kokkos::create_mirror_view_and_copy(HostSpace(), list.second);
    auto const image = Kokkos::create_mirror_view_and_copy(HostSpace(), list.image);
    auto const touching = Kokkos::create_mirror_view_and_copy(HostSpace(), list.touching);
    auto const adhering = Kokkos::create_mirror_view_and_copy(HostSpace(), list.adhering);
    auto const spring = Kokkos::create_mirror_view_and_copy(HostSpace(), list.spring);
    auto const force = Kokkos::create_mirror_view_and_copy(HostSpace(), list.force);
    std::vector<ListedPair> pairs(list.count);
    for (int c = 0; c < list.count; ++c) {
        ListedPair& pair = pairs[c];
        pair = {id(first(c)), id(second(c)), list.periodic ? image(c) : PeriodicBox::no_image, {}, touching(c), 0};
        if (list.needs.bonds) pair.adhering = adhering(c);
        for (int n = 0; n < 3 && list.needs.history; ++n) pair.spring[n] = spring(c, n);
        for (int n = 0; n < 8; ++n) pair.force[n] = force(c, n);
    }
    std::sort(pairs.begin(), pairs.end(), [](ListedPair const& a, ListedPair const& b) {
        return std::tie(a.first, a.second) < std::tie(b.first, b.second);
    });
    return pairs;
}

Real hertz_energy(GrainSystem const& system)
{
    std::vector<Grain> const grains = grains_by_id(system);
    Real energy = 0;
    for (ListedPair const& pair : listed_pairs(system)) {
        Grain const &a = grains.at(pair.first), &b = grains.at(pair.second); // ids are 0 ..
        Vec3 const offset = a.position - b.position - system.settings.box.image_shift(pair.image);
        Real const overlap = (a.diameter + b.diameter) / 2 - norm(offset);
        if (overlap <= 0) continue;
        Real const radius = a.diameter * b.diameter / (2 * (a.diameter + b.diameter));
        energy += Real(8) / 15 * system.pairs[0].effective_youngs_modulus * std::sqrt(radius) * std::pow(overlap, Real(2.5));
    }
    return energy;
}

namespace {

void mix_in(std::uint64_t& hash, void const* data, std::size_t bytes) // FNV-1a
{
    auto const* const byte = static_cast<unsigned char const*>(data);
    for (std::size_t n = 0; n < bytes; ++n) hash = (hash ^ byte[n]) * 1099511628211ull;
}

} // namespace

std::uint64_t state_hash(GrainSystem const& system)
{
    std::uint64_t hash = 14695981039346656037ull;
    for (Grain const& grain : grains_by_id(system)) {
        mix_in(hash, &grain.id, sizeof grain.id);
        mix_in(hash, &grain.position, sizeof grain.position);
        mix_in(hash, &grain.velocity, sizeof grain.velocity);
        mix_in(hash, &grain.spin, sizeof grain.spin);
    }
    for (ListedPair const& pair : listed_pairs(system)) {
        if (!pair.touching && !pair.adhering) continue; // merely near: that depends on the skin
        mix_in(hash, &pair.first, sizeof pair.first);
        mix_in(hash, &pair.second, sizeof pair.second);
        mix_in(hash, pair.spring, sizeof pair.spring);
        mix_in(hash, &pair.adhering, sizeof pair.adhering);
    }
    return hash;
}

} // namespace arenite
