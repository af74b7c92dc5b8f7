// SPDX-License-Identifier: MIT
// The contact search beyond the verification packs: few grains, far grains, and what contacts remember.
#include "apps/verify/packs.hpp"
#include "core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <limits>
#include <map>

namespace arenite {
namespace {

SystemSettings open_system(std::vector<Grain> grains)
{
    SystemSettings settings;
    settings.grains = std::move(grains);
    settings.materials = {with(sand(), 0.8, 0.3)};
    settings.contact = contact_settings(NormalLaw::modified_jkr, DampingLaw::restitution, TangentialLaw::secant);
    settings.skin = 2e-5;
    settings.dt = 1e-8;
    settings.start_bonded = true;
    return settings;
}

TEST(ContactSearch, TakesNoneOneAndTwoGrains)
{
    std::vector<Grain> grains;
    for (int count = 0; count <= 2; ++count) {
        SystemSettings settings = open_system(grains);
        for (bool const periodic : {false, true}) {
            settings.box.upper = {1e-3, 1e-3, 1e-3};
            for (bool& axis : settings.box.periodic) axis = periodic;
            GrainSystem system = make_system(settings);
            EXPECT_EQ(system.contacts.count, count == 2 ? 1 : 0);
            EXPECT_EQ(wrong_pairs(system), 0);
            advance(system, 3);
            EXPECT_EQ(system.particles.count, count);
        }
        grains.push_back(make_grain(count, {0.5e-3 + count * 0.19e-3, 0.5e-3, 0.5e-3}, 0.2e-3));
    }
}

TEST(ContactSearch, FindsGrainsAtOnePlace)
{
    std::vector<Grain> grains;
    for (int i = 0; i < 20; ++i) grains.push_back(make_grain(i, {0, 0, 0}, 0.2e-3));
    GrainSystem const system = make_system(open_system(grains));
    EXPECT_EQ(system.contacts.count, 190);
    EXPECT_EQ(wrong_pairs(system), 0);
}

// Several edges outside: a file of positions need not be wrapped.
TEST(ContactSearch, WrapsGrainsFromFarOutside)
{
    PackSettings pack;
    pack.count = 300;
    pack.largest = 1e-3;
    pack.overhang = 3.3e-2; // the box is 1e-2
    SystemSettings settings = open_system(random_pack(pack));
    settings.box.upper = {pack.box, pack.box, pack.box};
    settings.box.periodic[0] = settings.box.periodic[2] = true;
    GrainSystem const system = make_system(settings);
    for (Grain const& grain : grains_by_id(system)) {
        EXPECT_GE(grain.position.x, 0);
        EXPECT_LT(grain.position.x, pack.box);
    }
    EXPECT_EQ(wrong_pairs(system), 0);
}

TEST(ContactSearch, RefusesAPeriodicEdgeOfLessThanTwoCutoffs)
{
    SystemSettings settings = open_system({make_grain(0, {0, 0, 0}, 0.2e-3)});
    settings.box.upper = {1e-3, 0.43e-3, 1e-3};
    settings.box.periodic[1] = true;
    EXPECT_THROW(make_system(settings), InputError);
    settings.box.upper.y = 0.45e-3;
    EXPECT_NO_THROW(make_system(settings));
}

TEST(ContactSearch, AGrainFarAwayDoesNotMakeTheGridHuge)
{
    PackSettings pack;
    pack.count = 500;
    pack.largest = 1e-3;
    SystemSettings settings = open_system(random_pack(pack));
    settings.grains[7].position = {40, -300, 2e5};
    GrainSystem const system = make_system(settings);
    EXPECT_EQ(wrong_pairs(system), 0);
}

// A grain that was thrown out is there until departures are looked for. All others in one cell would be a search of N^2.
TEST(ContactSearch, AGrainFarAwayDoesNotMakeTheSearchSlow)
{
    PackSettings pack;
    pack.count = 40000;
    pack.largest = 1e-3;
    pack.box = 4e-2;
    SystemSettings settings = open_system(random_pack(pack));
    settings.box.upper = {pack.box, pack.box, pack.box};
    auto const seconds_of_a_search = [&] {
        GrainSystem system = make_system(settings);
        auto const begin = std::chrono::steady_clock::now();
        rebuild(system);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    double const near = seconds_of_a_search();
    for (Real const away : {Real(-1e3), Real(1e100)}) {
        settings.grains[7].position.y = away;
        EXPECT_LT(seconds_of_a_search(), 10 * near) << "a grain at " << away << " m"; // all in one cell: 35 times and more
    }
    pack.count = 500;
    settings.grains = random_pack(pack);
    settings.grains[7].position = {1e100, -1, 0};
    settings.grains[8].position = settings.grains[7].position;
    EXPECT_EQ(wrong_pairs(make_system(settings)), 0);
}

TEST(ContactSearch, StopsAtPositionsThatAreNotFinite)
{
    for (Real const bad : {std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity()}) {
        SystemSettings settings = open_system({make_grain(0, {0, 0, 0}, 0.2e-3), make_grain(17, {0, bad, 0}, 0.2e-3)});
        try {
            make_system(settings);
            ADD_FAILURE() << bad;
        } catch (SimulationError const& error) {
            EXPECT_NE(std::string(error.what()).find("17"), std::string::npos) << error.what();
        }
    }
}

std::vector<ListedPair> remembered(GrainSystem const& system)
{
    std::vector<ListedPair> pairs = listed_pairs(system);
    std::erase_if(pairs, [](ListedPair const& pair) { return !pair.touching && !pair.adhering; });
    return pairs;
}

bool same(ListedPair const& a, ListedPair const& b)
{
    return a.first == b.first && a.second == b.second && a.adhering == b.adhering && a.touching == b.touching &&
           std::memcmp(a.spring, b.spring, sizeof a.spring) == 0;
}

GrainSystem dense_system(std::vector<Grain> const& extra = {})
{
    PackSettings pack;
    pack.count = 400;
    pack.box = 1.5e-3;
    pack.largest = 0.24e-3;
    pack.size_ratio = 2.4;
    pack.speed = 1;
    pack.spin = 1000;
    pack.lattice = true;
    std::vector<Grain> grains = random_pack(pack);
    grains.insert(grains.end(), extra.begin(), extra.end());
    GrainSystem system = make_system(open_system(grains));
    advance(system, 20);
    return system;
}

TEST(ContactSearch, CarriesMemoryOverExactly)
{
    GrainSystem system = dense_system();
    std::vector<ListedPair> const before = remembered(system);
    ASSERT_GT(before.size(), 100u);
    EXPECT_TRUE(std::any_of(before.begin(), before.end(), [](ListedPair const& p) { return p.adhering; }));
    for (int n = 0; n < 2; ++n) {
        system.settings.skin *= 1.7;
        rebuild(system);
        std::vector<ListedPair> const after = remembered(system);
        ASSERT_EQ(after.size(), before.size());
        for (std::size_t c = 0; c < before.size(); ++c) EXPECT_TRUE(same(before[c], after[c])) << c;
    }
}

void drop_grain(GrainSystem& system, GrainId gone)
{
    View1<int> const keep("keep", system.particles.count);
    auto const host = Kokkos::create_mirror_view(keep);
    auto const id = Kokkos::create_mirror_view_and_copy(HostSpace(), system.particles.id);
    for (int row = 0; row < system.particles.count; ++row) host(row) = id(row) != gone;
    Kokkos::deep_copy(keep, host);
    search_contacts(system.particles, system.settings.box, {system.settings.skin, system.contacts.needs, keep},
                    system.contacts);
}

// The largest grain sets the size levels; when it leaves, the other contacts must not lose their memory.
TEST(ContactSearch, KeepsMemoryWhenTheLargestGrainLeaves)
{
    GrainSystem system = dense_system({make_grain(400, {5e-3, 5e-3, 5e-3}, 1.1e-3)});
    std::vector<ListedPair> const before = remembered(system);
    drop_grain(system, 400);
    EXPECT_EQ(system.particles.count, 400);
    std::vector<ListedPair> const after = remembered(system);
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t c = 0; c < before.size(); ++c) EXPECT_TRUE(same(before[c], after[c])) << c;
    EXPECT_EQ(wrong_pairs(system), 0);
}

TEST(ContactSearch, ForgetsThePairsOfAGrainThatLeaves)
{
    GrainSystem system = dense_system();
    std::vector<ListedPair> before = remembered(system);
    GrainId const gone = before[before.size() / 2].first;
    std::erase_if(before, [&](ListedPair const& pair) { return pair.first == gone || pair.second == gone; });
    drop_grain(system, gone);
    EXPECT_EQ(wrong_pairs(system), 0);
    std::vector<ListedPair> const after = remembered(system);
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t c = 0; c < before.size(); ++c) EXPECT_TRUE(same(before[c], after[c])) << c;
}

using ForcesByPair = std::map<std::pair<GrainId, GrainId>, std::array<Real, 8>>;

/// Of the contacts that touch.
ForcesByPair forces_by_pair(GrainSystem const& system)
{
    ForcesByPair forces;
    for (ListedPair const& pair : listed_pairs(system))
        if (pair.touching) forces[{pair.first, pair.second}] = pair.force;
    return forces;
}

TEST(ContactSearch, CarriesForcesOrBeginsWithZerosWhereTheyFollow)
{
    for (int const tile : {0, 50}) {
        ForcesByPair evaluated[2];
        for (bool const follow : {false, true}) {
            GrainSystem system = dense_system();
            ForcesByPair const before = forces_by_pair(system);
            ASSERT_GT(before.size(), 100u);
            for (Real const wider : {1.7, 0.9}) { // rows that the old list has not; rows that it has
                system.settings.skin *= wider;
                SearchSettings settings{system.settings.skin, system.contacts.needs, {}};
                settings.tile_grains = tile;
                settings.forces_follow = follow;
                search_contacts(system.particles, system.settings.box, settings, system.contacts);
                ForcesByPair expected = before;
                if (follow)
                    for (auto& [pair, row] : expected) row = {};
                EXPECT_EQ(forces_by_pair(system), expected);
                auto const rows = Kokkos::create_mirror_view_and_copy(HostSpace(), system.contacts.force);
                if (!follow) continue;
                for (std::size_t c = 0; c < rows.extent(0); ++c) // the kernel leaves those that do not touch as they are
                    EXPECT_EQ(rows(c, 0) * rows(c, 0) + rows(c, 7), 0) << c;
            }
            evaluate(system);
            evaluated[follow] = forces_by_pair(system);
        }
        EXPECT_EQ(evaluated[0], evaluated[1]);
        EXPECT_GT(evaluated[1].size(), 100u);
    }
}

// What a law does not ask for takes no memory; what it asks for is of the right size.
TEST(ContactSearch, ListsHoldWhatTheLawNeeds)
{
    GrainSystem system = dense_system();
    for (bool const history : {false, true})
        for (bool const bonds : {false, true}) {
            bool const radius = history && !bonds;
            search_contacts(system.particles, system.settings.box, {system.settings.skin, {history, bonds, radius}, {}},
                            system.contacts);
            ContactList const& list = system.contacts;
            std::size_t const rows = list.first.extent(0);
            ASSERT_GE(rows, static_cast<std::size_t>(list.count));
            EXPECT_EQ(list.spring.extent(0), history ? rows : 0);
            EXPECT_EQ(list.contact_radius.extent(0), radius ? rows : 0);
            EXPECT_EQ(list.adhering.extent(0), bonds ? rows : 0);
            EXPECT_EQ(list.inverse_cube_root.extent(0), bonds ? rows : 0);
            if (!bonds) continue;
            auto const scale = Kokkos::create_mirror_view_and_copy(HostSpace(), list.scale);
            auto const root = Kokkos::create_mirror_view_and_copy(HostSpace(), list.inverse_cube_root);
            for (int c = 0; c < list.count; ++c) EXPECT_DOUBLE_EQ(root(c), 1 / std::cbrt(scale(c, 0))) << c;
        }
}

TEST(ContactSearch, CarriesTheContactRadiusWhereBothListsHaveOne)
{
    GrainSystem system = dense_system();
    auto const search = [&](bool radius) {
        search_contacts(system.particles, system.settings.box, {system.settings.skin, {true, true, radius}, {}},
                        system.contacts);
    };
    auto const radii = [&] { // of the contacts that touched, and of those that did not
        auto const radius = Kokkos::create_mirror_view_and_copy(HostSpace(), system.contacts.contact_radius);
        auto const touching = Kokkos::create_mirror_view_and_copy(HostSpace(), system.contacts.touching);
        std::map<Real, int> count[2];
        for (int c = 0; c < system.contacts.count; ++c) ++count[touching(c)][radius(c)];
        return std::pair(count[1], count[0]);
    };
    search(true);
    EXPECT_EQ(radii().first.size(), 1u);
    EXPECT_EQ(radii().first.count(0), 1u) << "the list before had none";
    Kokkos::deep_copy(system.contacts.contact_radius, 2e-6);
    system.settings.skin *= 1.7; // more pairs that do not touch
    search(true);
    auto const [touching, others] = radii();
    EXPECT_EQ(touching.size(), 1u);
    EXPECT_EQ(touching.count(2e-6), 1u);
    EXPECT_EQ(others.count(0), 1u);
}

TEST(ContactSearch, BondsAndCoordinationAreCounted)
{
    std::vector<Grain> grains;
    for (int i = 0; i < 4; ++i) grains.push_back(make_grain(i, {i * 0.1999e-3, 0, 0}, 0.2e-3));
    grains[3].position.x += 1e-6; // near, does not touch
    GrainSystem system = make_system(open_system(grains));
    View1<int> const bonds("bonds", 4), coordination("coordination", 4);
    count_bonds(system.particles, system.contacts, bonds, coordination);
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), bonds);
    auto const touching = Kokkos::create_mirror_view_and_copy(HostSpace(), coordination);
    auto const id = Kokkos::create_mirror_view_and_copy(HostSpace(), system.particles.id);
    int const expected[] = {1, 2, 1, 0};
    for (int row = 0; row < 4; ++row) {
        EXPECT_EQ(host(row), expected[id(row)]);
        EXPECT_EQ(touching(row), expected[id(row)]);
    }
    EXPECT_EQ(form_bonds(system.particles, system.settings.box, system.contacts, pair_table(system.law)), 2);
}

} // namespace
} // namespace arenite
