// SPDX-License-Identifier: MIT
#include "tests/wall_scene.hpp"

#include "core/to_device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace arenite {
namespace {

using namespace test;

std::vector<Triangle> box_mesh_inside(Vec3 const& lower, Vec3 const& upper)
{
    auto const corner = [&](int n) {
        return Vec3{n & 1 ? upper.x : lower.x, n & 2 ? upper.y : lower.y, n & 4 ? upper.z : lower.z};
    };
    int const faces[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};
    std::vector<Triangle> mesh;
    for (auto const& f : faces)
        for (int k : {1, 2}) mesh.push_back({{corner(f[0]), corner(f[k]), corner(f[k + 1])}});
    return mesh;
}

std::vector<Grain> random_grains(int count, Vec3 const& lower, Vec3 const& upper, int seed, Real speed = 0)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<Real> unit(0, 1);
    std::vector<Grain> grains;
    for (int n = 0; n < count; ++n) {
        Vec3 x, v;
        for (int axis = 0; axis < 3; ++axis) {
            x[axis] = lower[axis] + unit(random) * (upper[axis] - lower[axis]);
            v[axis] = speed * (unit(random) - Real(0.5));
        }
        grains.push_back(grain(x, 1e-3 * (0.5 + unit(random)), v));
        grains.back().spin = 100 * v;
    }
    return grains;
}

/// Total wall force of each grain, by id, from one evaluation.
std::vector<Vec3> wall_forces(WallScene& scene)
{
    scene.start(1e-7, {});
    std::vector<Vec3> force(scene.particles.count);
    auto const rows = Kokkos::create_mirror_view_and_copy(HostSpace(), scene.wall_contacts.force);
    auto const id = Kokkos::create_mirror_view_and_copy(HostSpace(), scene.wall_contacts.id);
    for (int c = 0; c < scene.wall_contacts.count; ++c) force[id(c)] += Vec3{rows(c, 0), rows(c, 1), rows(c, 2)};
    return force;
}

TEST(WallContacts, MeshBoxPushesLikeSixPlanes)
{
    Vec3 const lower{0, 0, 0}, upper{10e-3, 7e-3, 5e-3};
    std::vector<Grain> const grains = random_grains(2000, lower, upper, 1, 0.1);
    WallSettings mesh;
    mesh.name = "mesh";
    mesh.material = "sand";
    mesh.shape = WallShape::mesh;
    WallScene a(grains, {box_wall(lower, upper, true)}, sand());
    WallScene b(grains, {mesh}, sand(), {{"mesh", box_mesh_inside(lower, upper)}});
    std::vector<Vec3> const by_planes = wall_forces(a), by_mesh = wall_forces(b);
    int pushed = 0;
    for (std::size_t n = 0; n < grains.size(); ++n) {
        pushed += norm(by_planes[n]) > 0;
        EXPECT_LE(norm(by_planes[n] - by_mesh[n]), 1e-12 * norm(by_planes[n])) << n; // facets' normals are rounded
    }
    EXPECT_GT(pushed, 500);
}

// A law that knows the grains' one material takes a shorter way along flat faces.
TEST(WallContacts, OneMaterialOfAllGrainsPushesAsOneOfSeveral)
{
    Vec3 const lower{0, 0, 0}, upper{10e-3, 7e-3, 5e-3};
    std::vector<Grain> const grains = random_grains(2000, lower, upper, 4, 0.1);
    std::vector<WallSettings> const walls{box_wall(lower, upper, true), plane({5e-3, 0, 0}, {1, 0.2, 0})};
    WallScene several(grains, walls, sand()), one(grains, walls, sand());
    one.law = make_contact_law({make_pair(sand(), sand(), {})}, 0);
    std::vector<Vec3> const expected = wall_forces(several), found = wall_forces(one);
    int pushed = 0;
    for (std::size_t n = 0; n < grains.size(); ++n) {
        pushed += norm(expected[n]) > 0;
        EXPECT_LE(norm(found[n] - expected[n]), 1e-14 * norm(expected[n])) << n;
    }
    EXPECT_GT(pushed, 500);
}

TEST(WallContacts, ReactionIsMinusTheForcesOnTheGrains)
{
    Vec3 const lower{0, 0, 0}, upper{10e-3, 7e-3, 5e-3};
    std::vector<Grain> const grains = random_grains(3000, lower, upper, 2, 0.1);
    WallScene scene(grains, {box_wall(lower, upper, true), plane({5e-3, 0, 0}, {1, 0.2, 0})}, sand());
    scene.start(1e-7, {});
    std::vector<WallReaction> const reactions = measure_walls(scene.particles, scene.walls, scene.wall_contacts);
    auto const rows = Kokkos::create_mirror_view_and_copy(HostSpace(), scene.wall_contacts.force);
    auto const normal = Kokkos::create_mirror_view_and_copy(HostSpace(), scene.wall_contacts.normal);
    auto const element = Kokkos::create_mirror_view_and_copy(HostSpace(), scene.wall_contacts.element);
    auto const row = Kokkos::create_mirror_view_and_copy(HostSpace(), scene.wall_contacts.grain);
    auto const position = Kokkos::create_mirror_view_and_copy(HostSpace(), scene.particles.position);
    Vec3 force[2], torque[2];
    for (int c = 0; c < scene.wall_contacts.count; ++c) {
        int const wall = element(c) < 6 ? 0 : 1;
        Vec3 const f{rows(c, 0), rows(c, 1), rows(c, 2)};
        Vec3 const point = vector_of(position, row(c)) - rows(c, 3) * vector_of(normal, c);
        force[wall] -= f;
        torque[wall] -= cross(point - (wall == 0 ? Real(0.5) * upper : Vec3{5e-3, 0, 0}), f);
    }
    for (int w = 0; w < 2; ++w) {
        EXPECT_GT(norm(force[w]), 0);
        EXPECT_LT(norm(reactions[w].force - force[w]), 1e-12 * reactions[w].stiffness * 1e-4);
        EXPECT_LT(norm(reactions[w].torque - torque[w]), 1e-12 * reactions[w].stiffness * 1e-6);
    }
}

TEST(WallContacts, BitsDoNotDependOnSkinOrOrderOfTheGrains)
{
    Vec3 const lower{0, 0, 0}, upper{10e-3, 7e-3, 5e-3};
    std::vector<Grain> grains = random_grains(9000, lower, upper, 3, 0.1);
    for (std::size_t n = 0; n < grains.size(); ++n) grains[n].id = static_cast<GrainId>(n);
    std::vector<WallReaction> reference;
    for (Real factor : {1.0, 0.1, 3.0}) {
        WallScene scene(grains, {box_wall(lower, upper, true)}, sand());
        scene.skin *= factor;
        scene.start(1e-7, {});
        std::vector<WallReaction> const found = measure_walls(scene.particles, scene.walls, scene.wall_contacts);
        if (reference.empty()) reference = found;
        EXPECT_EQ(found[0].force, reference[0].force);
        EXPECT_EQ(found[0].torque, reference[0].torque);
        EXPECT_EQ(found[0].impedance, reference[0].impedance);
        std::reverse(grains.begin(), grains.end());
    }
}

TEST(WallContacts, MemorySurvivesSearchSortAndCheckpoint)
{
    Vec3 const lower{0, 0, 0}, upper{10e-3, 7e-3, 5e-3};
    std::vector<Grain> const grains = random_grains(3000, lower, upper, 4, 0.1);
    WallScene scene(grains, {box_wall(lower, upper, true)}, sand());
    scene.start(1e-7, {});
    auto const memory = [&](WallContacts const& contacts) {
        std::map<std::pair<GrainId, int>, std::vector<Real>> found;
        auto const arrays = save_wall_contacts(contacts);
        for (std::size_t c = 0; c < arrays.at("id").size(); ++c) {
            if (!arrays.at("touching")[c]) continue;
            auto& values = found[{static_cast<GrainId>(arrays.at("id")[c]), static_cast<int>(arrays.at("element")[c])}];
            for (char const* name : {"normal", "spring"})
                values.insert(values.end(), arrays.at(name).begin() + 4 * c, arrays.at(name).begin() + 4 * c + 4);
            values.insert(values.end(), arrays.at("force").begin() + 8 * c, arrays.at("force").begin() + 8 * c + 8);
        }
        return found;
    };
    auto const before = memory(scene.wall_contacts);
    EXPECT_GT(before.size(), 1000u);
    WallContacts restored = restore_wall_contacts(save_wall_contacts(scene.wall_contacts));
    std::vector<int> reversed(scene.particles.count);
    for (int n = 0; n < scene.particles.count; ++n) reversed[n] = scene.particles.count - 1 - n;
    permute(scene.particles, to_device(reversed, "order"));
    search_wall_contacts(scene.particles, scene.walls, 2 * scene.skin, scene.wall_contacts.needs, scene.wall_contacts);
    EXPECT_EQ(memory(scene.wall_contacts), before);
    search_wall_contacts(scene.particles, scene.walls, scene.skin, restored.needs, restored);
    EXPECT_EQ(memory(restored), before);
}

TEST(WallContacts, IncidenceNamesEveryRowOnceByElement)
{
    Vec3 const lower{0, 0, 0}, upper{3e-3, 3e-3, 3e-3};
    WallScene scene(random_grains(500, lower, upper, 5), {plane({0, 0, 0}, {0, 0, 1}), box_wall(lower, upper, true)},
                    sand());
    scene.start(1e-7, {});
    int const count = scene.wall_contacts.count;
    auto const host = [](auto const& view) { return Kokkos::create_mirror_view_and_copy(HostSpace(), view); };
    auto const begin = host(scene.wall_contacts.begin), contact = host(scene.wall_contacts.contact),
               row = host(scene.wall_contacts.grain), element = host(scene.wall_contacts.element);
    auto const row_id = host(scene.wall_contacts.id), id = host(scene.particles.id);
    std::vector<int> seen(count, 0);
    for (int i = 0; i < scene.particles.count; ++i)
        for (int k = begin(i); k < begin(i + 1); ++k) {
            int const c = contact(k);
            ++seen[c];
            EXPECT_EQ(row(c), i);
            EXPECT_EQ(row_id(c), id(i));
            if (k > begin(i)) { EXPECT_GT(element(c), element(contact(k - 1))); }
        }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), count);
}

TEST(WallContacts, NoGrainsAndNoWallsAreFine)
{
    WallScene none({}, {plane({0, 0, 0}, {0, 0, 1})}, sand());
    none.start(1e-7, {});
    EXPECT_EQ(measure_walls(none.particles, none.walls, none.wall_contacts)[0].force, (Vec3{}));
    WallScene bare({grain({0, 0, 0}, 1e-3)}, {}, sand());
    bare.start(1e-7, {});
    bare.run(3);
    EXPECT_EQ(bare.wall_contacts.count, 0);
}

TEST(WallContacts, AbsentWallsDoNotTouch)
{
    WallSettings floor = plane({0, 0, 0}, {0, 0, 1});
    floor.present = false;
    WallScene scene({grain({0, 0, 0.4e-3}, 1e-3)}, {floor}, sand());
    scene.start(1e-7, {});
    EXPECT_EQ(scene.wall_contacts.count, 0);
    WallAction add;
    add.wall = "plane";
    add.present = true;
    scene.start(1e-7, {}, {add});
    EXPECT_EQ(scene.wall_contacts.count, 1);
    EXPECT_EQ(save_wall_contacts(scene.wall_contacts).at("touching")[0], 1);
}

/// A grain of 1 mm that is pressed into the plane z = 0 by a tenth of a percent.
Grain resting_grain(Vec3 const& velocity = {}) { return grain({0, 0, 0.4995e-3}, 1e-3, velocity); }

Vec3 force_on_the_grain(WallScene const& scene)
{
    auto const rows = Kokkos::create_mirror_view_and_copy(HostSpace(), scene.wall_contacts.force);
    Vec3 sum;
    for (int c = 0; c < scene.wall_contacts.count; ++c) sum += Vec3{rows(c, 0), rows(c, 1), rows(c, 2)};
    return sum;
}

TEST(WallContacts, AGrainThatRidesWithAWallIsNotHitByIt)
{
    Real const strain_rate = -200, origin = 0.3; // 1/s; m
    auto const force_with = [&](bool rides, Vec3 const& own_velocity) {
        WallScene scene({resting_grain(own_velocity)}, {plane({0, 0, 0}, {0, 0, 1})}, sand());
        WallAction action;
        action.wall = "plane";
        Real const flow = strain_rate * (0.4995e-3 - origin); // where the grain is
        action.velocity = Vec3{0, 0, flow};
        if (rides) {
            scene.box.strain_rate.z = strain_rate;
            scene.box.strain_origin.z = origin;
        }
        scene.start(1e-7, {}, {action});
        return force_on_the_grain(scene).z;
    };
    WallScene still({resting_grain()}, {plane({0, 0, 0}, {0, 0, 1})}, sand());
    still.start(1e-7, {});
    Real const at_rest = force_on_the_grain(still).z;
    EXPECT_NEAR(force_with(true, {}), at_rest, 1e-12 * at_rest);
    EXPECT_GT(force_with(false, {}), 2 * at_rest) << "the wall comes at 60 m/s";
    EXPECT_NEAR(force_with(false, {0, 0, strain_rate * (0.4995e-3 - origin)}), at_rest, 1e-12 * at_rest);
}

MaterialSettings sticky_sand()
{
    MaterialSettings material = sand();
    material.surface_energy = 5;
    return material;
}

ContactSettings law_of(NormalLaw normal)
{
    ContactSettings contact;
    contact.normal = normal;
    contact.damping = DampingLaw::none;
    contact.break_point = normal == NormalLaw::jkr ? BreakPoint::S : BreakPoint::C;
    return contact;
}

TEST(WallContacts, ModifiedJkrBondsWhatTouchesAtTheStartAndNothingLater)
{
    auto const force_after = [&](bool bonded) {
        WallScene scene({resting_grain()}, {plane({0, 0, 0}, {0, 0, 1})}, sticky_sand(), {},
                        law_of(NormalLaw::modified_jkr));
        scene.settings.dt = 1e-9;
        scene.search();
        if (bonded) form_wall_bonds(scene.particles, scene.walls, scene.wall_contacts, pair_table(scene.law));
        scene.evaluate();
        return force_on_the_grain(scene).z;
    };
    PairConstants const pair = make_pair(sticky_sand(), sticky_sand(), law_of(NormalLaw::jkr));
    Real const overlap = 0.0005e-3, radius = 0.5e-3;
    Real const jkr = jkr_response(overlap, ContactScale<>{radius, 1, 1 / std::cbrt(radius)}, pair).force,
               hertz = hertz_response(overlap, radius, pair.effective_youngs_modulus).force;
    EXPECT_NEAR(force_after(true), jkr, 1e-12 * std::fabs(jkr));
    EXPECT_NEAR(force_after(false), hertz, 1e-9 * hertz);
    EXPECT_LT(jkr, 0.5 * hertz);
}

TEST(WallContacts, AStretchedContactGoesOnWithTheNextFacet)
{
    // A flat square of two facets; the grain hangs below its force-free overlap and slides over their common edge.
    Vec3 const a{-1e-3, -1e-3, 0}, b{1e-3, -1e-3, 0}, c{1e-3, 1e-3, 0}, d{-1e-3, 1e-3, 0};
    WallSettings mesh;
    mesh.name = "mesh";
    mesh.material = "sand";
    mesh.shape = WallShape::mesh;
    MaterialSettings material = sticky_sand();
    material.friction = 0;
    PairConstants const pair = make_pair(material, material, law_of(NormalLaw::jkr));
    Real const radius = 0.5e-3, stretch = 0.5 * pair.break_overlap * pair.length_factor * std::cbrt(radius); // m, < 0
    WallScene scene({grain({0.1e-3, -0.1e-3, 0.4995e-3}, 1e-3)}, {mesh}, material, {{"mesh", {{{a, b, c}}, {{a, c, d}}}}},
                    law_of(NormalLaw::jkr));
    scene.settings.dt = 1e-9;
    scene.search();
    scene.evaluate(); // it touches and sticks
    auto const move_to = [&](Vec3 const& x) {
        auto const position = Kokkos::create_mirror_view_and_copy(HostSpace(), scene.particles.position);
        set_vector(position, 0, x);
        Kokkos::deep_copy(scene.particles.position, position);
        scene.evaluate();
        return force_on_the_grain(scene).z;
    };
    Real const expected = jkr_response(stretch, ContactScale<>{radius, 1, 1 / std::cbrt(radius)}, pair).force;
    ASSERT_LT(expected, 0);
    Real const height = radius - stretch;
    EXPECT_NEAR(move_to({0.1e-3, -0.1e-3, height}), expected, 1e-9 * -expected);
    EXPECT_NEAR(move_to({-0.1e-3, 0.1e-3, height}), expected, 1e-9 * -expected) << "on the other facet";
    EXPECT_NEAR(move_to({0.1e-3, -0.1e-3, height}), expected, 1e-9 * -expected) << "and back";
    EXPECT_EQ(move_to({0.1e-3, -0.1e-3, 2 * radius}), 0) << "broken";
    EXPECT_EQ(move_to({0.1e-3, -0.1e-3, height}), 0) << "apart, nothing holds it";
}

} // namespace
} // namespace arenite
