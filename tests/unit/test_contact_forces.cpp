// SPDX-License-Identifier: MIT
// The contact kernel on pairs of grains: symmetry, hard geometry, images, a deforming box.
#include "apps/verify/grain_system.hpp"
#include "kernels/contact_lanes.hpp"
#include "kernels/energy_terms.hpp"

#include <gtest/gtest.h>

namespace arenite {
namespace {

SystemSettings rough_pair(Grain const& a, Grain const& b)
{
    SystemSettings settings;
    settings.materials = {with(sand(), 0.8, 0.3)};
    settings.contact = contact_settings(NormalLaw::jkr, DampingLaw::restitution, TangentialLaw::secant);
    settings.grains = {a, b};
    settings.skin = 2e-5;
    settings.dt = 1e-8;
    return settings;
}

struct Loads {
    Vec3 force[2], torque[2];
};

/// Forces and torques by id after one evaluation as of a step of dt.
Loads loads_of(SystemSettings const& settings)
{
    GrainSystem system = make_system(settings);
    evaluate(system);
    StepSettings step;
    step.dt = settings.dt;
    kick(system.integrator, step, system.particles, system.contacts, {});
    EXPECT_FALSE(read_health(system.integrator) & force_is_not_finite);
    auto const force = Kokkos::create_mirror_view_and_copy(HostSpace(), system.particles.force);
    auto const torque = Kokkos::create_mirror_view_and_copy(HostSpace(), system.particles.torque);
    auto const id = Kokkos::create_mirror_view_and_copy(HostSpace(), system.particles.id);
    Loads loads;
    for (int row = 0; row < 2; ++row) {
        loads.force[id(row)] = vector_of(force, row);
        loads.torque[id(row)] = vector_of(torque, row);
    }
    return loads;
}

Grain first() { return make_grain(0, {0, 0, 0}, 0.2e-3, {0.1, 0.2, -0.1}, {300, -200, 500}); }
Grain second() { return make_grain(1, {0.2e-3, 0.07e-3, 0}, 0.23e-3, {-0.2, 0.1, 0}, {0, 900, -100}); }

void expect_equal(Loads const& a, Loads const& b, Real tolerance)
{
    for (int i = 0; i < 2; ++i) {
        EXPECT_LE(norm(a.force[i] - b.force[i]), tolerance * norm(a.force[i]));
        EXPECT_LE(norm(a.torque[i] - b.torque[i]), tolerance * norm(a.torque[i]));
    }
}

TEST(ContactForces, AreOppositeToTheLastBit)
{
    Loads const loads = loads_of(rough_pair(first(), second()));
    EXPECT_GT(norm(loads.force[0]), 0);
    EXPECT_TRUE(loads.force[0] == -loads.force[1]);
    EXPECT_GT(norm(loads.torque[0]), 0);
}

TEST(ContactForces, DoNotKnowWhichGrainIsFirst)
{
    Grain a = first(), b = second();
    Loads const straight = loads_of(rough_pair(a, b));
    std::swap(a.id, b.id);
    Loads const swapped = loads_of(rough_pair(a, b));
    constexpr Real rounding = 1e-10; // of overlap / radius 1e-3 and of the jump at the touch
    for (int i = 0; i < 2; ++i) {
        EXPECT_LE(norm(straight.force[i] - swapped.force[1 - i]), rounding * norm(straight.force[i]));
        EXPECT_LE(norm(straight.torque[i] - swapped.torque[1 - i]), rounding * norm(straight.torque[i]));
    }
}

TEST(ContactForces, ReachAcrossPeriodicFaces)
{
    Loads const inside = loads_of(rough_pair(first(), second()));
    SystemSettings settings = rough_pair(first(), second());
    settings.box.lower = {-0.1e-3, -1e-3, -1e-3};
    settings.box.upper = {0.9e-3, 1e-3, 1e-3};
    settings.box.periodic[0] = settings.box.periodic[1] = true;
    settings.grains[1].position += Vec3{-1e-3, 2e-3, 0};
    expect_equal(loads_of(settings), inside, 1e-9); // the positions' rounding over an overlap of 1e-6 m
}

// Grains ride on the box's flow: what a pair feels must not depend on where in the box it is.
TEST(ContactForces, InADeformingBoxAreTheSameEverywhere)
{
    SystemSettings settings = rough_pair(first(), second());
    settings.box.upper = {1e-3, 1e-3, 1e-3};
    settings.box.strain_rate = {-200, 150, 300};
    for (bool& axis : settings.box.periodic) axis = true;
    Loads loads[2];
    for (int n = 0; n < 2; ++n) {
        Vec3 const corner = n == 0 ? Vec3{0.3e-3, 0.3e-3, 0.3e-3} : Vec3{0.9e-3, 0.98e-3, 0.3e-3};
        settings.grains[0].position = first().position + corner;
        settings.grains[1].position = second().position + corner;
        loads[n] = loads_of(settings);
    }
    expect_equal(loads[1], loads[0], 1e-9);
    settings.box.strain_rate = {};
    EXPECT_GT(norm(loads_of(settings).force[0] - loads[0].force[0]),
              1e-6 * norm(loads[0].force[0])); // and they feel it
}

TEST(ContactForces, ConcentricGrainsPartAlongZ)
{
    for (Real const diameter : {0.2e-3, 0.1e-3}) {
        Grain a = make_grain(0, {1e-3, 0, 0}, 0.2e-3), b = make_grain(1, {1e-3, 0, 0}, diameter);
        for (NormalLaw const law : {NormalLaw::hertz, NormalLaw::jkr}) {
            SystemSettings settings = rough_pair(a, b);
            settings.contact.normal = law;
            Loads const loads = loads_of(settings);
            EXPECT_GT(std::fabs(loads.force[0].z), 0);
            EXPECT_EQ(loads.force[0].x, 0);
            EXPECT_TRUE(loads.force[0] == -loads.force[1]);
        }
    }
}

// A grain inside a larger one: arms of (r_i^2 - r_j^2) / distance would grow without bound.
TEST(ContactForces, ArmsStayWithinTheGrains)
{
    Grain const large = make_grain(0, {0, 0, 0}, 1e-3, {}, {0, 0, 1e3}),
                small = make_grain(1, {1e-6, 0, 0}, 0.1e-3, {0, 1, 0});
    Loads const loads = loads_of(rough_pair(large, small));
    EXPECT_LE(norm(loads.torque[0]), 0.5e-3 * norm(loads.force[0]) * (1 + 1e-12));
    EXPECT_LE(norm(loads.torque[1]), 0.05e-3 * norm(loads.force[1]) * (1 + 1e-12));
}

TEST(ContactForces, SeparationForgetsTheSpring)
{
    SystemSettings settings =
        rough_pair(make_grain(0, {0, 0, 0}, 0.2e-3), make_grain(1, {0.1999e-3, 0, 0}, 0.2e-3, {}, {0, 0, 5e3}));
    settings.contact.normal = NormalLaw::hertz;
    GrainSystem system = make_system(settings);
    evaluate(system);
    EXPECT_NE(listed_pairs(system)[0].spring[1], 0);
    place(system, 1, {0.201e-3, 0, 0}, {}, {});
    evaluate(system);
    ListedPair const pair = listed_pairs(system)[0];
    EXPECT_FALSE(pair.touching);
    for (Real const value : pair.spring) EXPECT_EQ(value, 0);
}

/// Twelve pairs of grains, far from each other: more than a vector holds, and not a whole number of vectors.
SystemSettings pairs_of_two_materials()
{
    SystemSettings settings = rough_pair(first(), second());
    MaterialSettings dry = with(sand(), 0.5, 0.6);
    dry.name = "dry";
    dry.youngs_modulus /= 3;
    dry.surface_energy = 0;
    settings.materials.push_back(dry);
    settings.grains.clear();
    for (int n = 0; n < 12; ++n)
        for (Grain grain : {first(), second()}) {
            grain.material = (grain.id == 0 ? n : n / 2) % 2;
            grain.position += Vec3{2e-3 * n, 0, 0};
            if (n == 5 && grain.id == 1) grain.position.y += 4e-5; // near, but apart
            grain.diameter *= 1 + 0.01 * n;
            grain.id += 2 * n;
            settings.grains.push_back(grain);
        }
    return settings;
}

TEST(ContactForces, DoNotDependOnWhoSharesTheVector)
{
    SystemSettings const together = pairs_of_two_materials();
    GrainSystem system = make_system(together);
    evaluate(system);
    kick(system.integrator, {}, system.particles, system.contacts, {});
    int touching = 0;
    for (int n = 0; n < 12; ++n) {
        SystemSettings alone = together;
        alone.grains = {together.grains[2 * n], together.grains[2 * n + 1]};
        GrainSystem pair = make_system(alone);
        evaluate(pair);
        kick(pair.integrator, {}, pair.particles, pair.contacts, {});
        Vec3 const force = force_on(pair, 2 * n);
        touching += norm(force) > 0;
        EXPECT_EQ(force_on(system, 2 * n), force) << n;
        EXPECT_EQ(force_on(system, 2 * n + 1), -force) << n;
    }
    EXPECT_EQ(touching, 11);
}

/// How often each block of a list of so many contacts comes, `close` of them close, `across` of these across tiles.
std::vector<int> visits(int contacts, int close, int across, int length)
{
    ContactList list;
    list.count = contacts;
    list.close = close;
    ContactPass pass = whole_step(list);
    pass.close_across = {std::max(0, pass.close.end - across), pass.close.end};
    pass.close.end = pass.close_across.begin;
    BlockTurns const turns(pass, length);
    View1<int> const count("visits", blocks_of(list));
    Kokkos::parallel_for(
        "visits", RangePolicy(0, turns.count), KOKKOS_LAMBDA(int k) {
            Range const blocks = turns(k);
            for (int block = blocks.begin; block < blocks.end; ++block) Kokkos::atomic_inc(&count(block));
        });
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), count);
    return {host.data(), host.data() + host.extent(0)};
}

/// A large grain, number `count`, and small ones all around it: every third has a gap, the others overlap with it.
SystemSettings crowd(int count, Real gap)
{
    SystemSettings settings = rough_pair(first(), second());
    settings.contact.normal = NormalLaw::hertz;
    settings.grains = {make_grain(count, {0, 0, 0}, 2e-3)};
    for (int n = 0; n < count; ++n) { // evenly, along a spiral
        Real const z = 1 - (2 * n + 1) / Real(count), angle = 2.399963 * n, across = std::sqrt(1 - z * z);
        Vec3 const direction{across * std::cos(angle), across * std::sin(angle), z};
        Real const distance = 1.05e-3 + (n % 3 == 0 ? gap : -1e-6 * (1 + n % 7));
        settings.grains.push_back(make_grain(n * 7 % count, distance * direction, 0.1e-3));
    }
    return settings;
}

Vec3 force_in_the_crowd(GrainSystem& system, int count)
{
    evaluate(system);
    kick(system.integrator, {}, system.particles, system.contacts, {});
    return force_on(system, count);
}

TEST(ContactForces, SumDoesNotTellWhatWasCloseWhenTheListWasBuilt)
{
    for (int const count : {20, 300, 500}) { // of 500, more are close than incident_place can tell
        SystemSettings const apart = crowd(count, 5e-6), touching = crowd(count, -2e-6);
        GrainSystem woken = make_system(apart), fresh = make_system(touching);
        Vec3 const before = force_in_the_crowd(woken, count);
        EXPECT_EQ(fresh.contacts.close, count);
        EXPECT_EQ(woken.contacts.close, count - (count + 2) / 3);
        for (Grain const& grain : touching.grains) place(woken, grain.id, grain.position, {}, {});
        Vec3 const after = force_in_the_crowd(woken, count);
        EXPECT_NE(after, before);
        EXPECT_EQ(after, force_in_the_crowd(fresh, count)) << count;
        EXPECT_EQ(woken.rebuilds, 1);
        // A list whose others carry a force when it is built knows of it.
        for (Grain const& grain : apart.grains) place(woken, grain.id, grain.position, {}, {});
        rebuild(woken);
        EXPECT_LT(woken.contacts.close, count);
        kick(woken.integrator, {}, woken.particles, woken.contacts, {});
        EXPECT_EQ(force_on(woken, count), after) << count;
    }
}

Terms<8> pair_power(GrainSystem const& system, ContactList const& contacts)
{
    SumWorkspace sums;
    Particles const& p = system.particles;
    CementedSand const law = std::get<CementedSand>(system.law);
    return reproducible_sums<8>(
        sums, "pair_power", blocks_of(contacts),
        PairPower<CementedSand>{law.pairs, contacts, p.position, p.velocity, p.spin, p.material, {}, {}});
}

// A list that has just been restored, or an earlier stage's, may not hold the radii.
TEST(ContactPower, IsTheSameWhereTheContactRadiusIsNotKnown)
{
    SystemSettings settings = crowd(300, -2e-6);
    settings.contact = contact_settings(NormalLaw::jkr, DampingLaw::restitution, TangentialLaw::dissipative);
    settings.materials = {with(sand(), 0.8, 0.3)};
    settings.dt = 1e-8;
    for (Grain& grain : settings.grains) grain.velocity = 1e3 * grain.position; // all of them part
    GrainSystem system = make_system(settings);
    evaluate(system);
    kick(system.integrator, {}, system.particles, system.contacts, {});
    ASSERT_TRUE(system.contacts.needs.contact_radius);
    ContactList without = system.contacts;
    without.needs.contact_radius = false;
    Terms<8> const known = pair_power(system, system.contacts), asked = pair_power(system, without);
    EXPECT_LT(known[0], 0); // the dashpots
    for (int n = 0; n < 8; ++n) EXPECT_NEAR(known[n], asked[n], 1e-12 * std::fabs(known[n])) << n;
}

TEST(ContactForces, TurnsVisitEveryBlockOnce)
{
    for (int const contacts : {0, 1, 8, 9, 803, 4096})
        for (int const close : {0, 1, contacts / 3, contacts - 1, contacts})
            for (int const length : {1, 3, 8, 1000})
                for (int const across : {0, 1, 7})
                    for (int const times : visits(contacts, std::clamp(close, 0, contacts), across, length))
                        EXPECT_EQ(times, 1);
}

} // namespace
} // namespace arenite
