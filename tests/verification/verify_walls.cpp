// SPDX-License-Identifier: MIT
// Grains on walls, against statics and mechanics of the rolling sphere.
#include "tests/wall_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace arenite {
namespace {

using namespace test;

constexpr Real gravity = 9.81, diameter = 1e-3;

Real mass_of(Real d) { return 2605 * 3.14159265358979323846 / 6 * d * d * d; }

WallSettings plate_with_hole(Real hole_diameter)
{
    WallSettings plate = plane({0, 0, 0}, {0, 0, 1}, "plate");
    plate.holes = {{"hole", {0, 0, 0}, hole_diameter}};
    return plate;
}

WallAction open_hole()
{
    WallAction action;
    action.wall = "plate";
    action.open = {"hole"};
    return action;
}

std::vector<Triangle> square_mesh(Real half, int n) // n x n squares with diagonals of both directions
{
    std::vector<Triangle> mesh;
    auto const at = [&](int a, int b) { return Vec3{half * (2.0 * a / n - 1), half * (2.0 * b / n - 1), 0}; };
    for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b) {
            Vec3 const p = at(a, b), q = at(a + 1, b), r = at(a + 1, b + 1), s = at(a, b + 1);
            if ((a + b) % 2) {
                mesh.push_back({{p, q, r}});
                mesh.push_back({{p, r, s}});
            } else {
                mesh.push_back({{p, q, s}});
                mesh.push_back({{q, r, s}});
            }
        }
    return mesh;
}

/// Validation T4: rolls with 5/7 g sin(theta) if tan(theta) <= 3.5 mu, else slides with g (sin - mu cos).
TEST(VerifyWalls, InclineRollsAndSlidesOnPlaneAndOnFacets)
{
    for (Real degrees : {5.0, 20.0, 50.0}) {
        Real const angle = degrees * 3.14159265358979323846 / 180, mu = 0.2;
        Vec3 const g{gravity * std::sin(angle), 0, -gravity * std::cos(angle)};
        bool const rolls = std::tan(angle) <= 3.5 * mu;
        Real const stiffness = 4.0 / 3 * 2e7 / (2 * (1 - 0.09)) * std::sqrt(diameter / 2); // both deform
        Real const overlap = std::pow(mass_of(diameter) * -g.z / stiffness, 2.0 / 3);
        // The grain rolls on the radius that is left above the contact plane: 5/7 becomes 1/(1 + 2/5 (R/arm)^2).
        Real const ratio = diameter / 2 / (diameter / 2 - overlap);
        Real const expected = rolls ? g.x / (1 + 0.4 * ratio * ratio) : g.x + mu * g.z;
        EXPECT_NEAR(ratio, 1, 3e-4);
        std::vector<Grain> const grains{grain({1.3e-4, 2.7e-4, diameter / 2 - overlap}, diameter)};
        WallSettings mesh;
        mesh.name = mesh.material = "sand";
        mesh.shape = WallShape::mesh;
        WallScene flat(grains, {plane({0, 0, 0}, {0, 0, 1})}, sand(mu, 0.3)),
            facets(grains, {mesh}, sand(mu, 0.3), {{"sand", square_mesh(1e-2, 79)}}); // 12482 triangles
        for (WallScene* scene : {&flat, &facets}) {
            scene->start(1e-6, g);
            scene->run(10000);
            Real const v0 = scene->grain_of(0).velocity.x;
            scene->run(20000);
            Grain const end = scene->grain_of(0);
            EXPECT_NEAR((end.velocity.x - v0) / (20000 * 1e-6) / expected, 1, 1e-6) << degrees;
            if (rolls) { EXPECT_NEAR(end.spin.y * (diameter / 2 - overlap) / end.velocity.x, 1, 1e-3); }
        }
        Grain const a = flat.grain_of(0), b = facets.grain_of(0);
        EXPECT_GT(a.position.x, 4e-4); // some facets of 0.25 mm further
        EXPECT_LT(norm(a.position - b.position), 1e-10 * diameter);
        EXPECT_LT(norm(a.velocity - b.velocity), 1e-9 * norm(a.velocity));
    }
}

TEST(VerifyWalls, GrainRestsOnTheRimOfASmallerHole)
{
    Real const hole = 0.6e-3; // the centre comes to rest at sqrt((R - overlap)^2 - r^2) above the plate
    WallScene scene({grain({2e-5, -1e-5, 0.46e-3}, diameter)}, {plate_with_hole(hole)}, sand(0.2, 0.3));
    scene.start(2e-6, {0, 0, -gravity}, {open_hole()});
    scene.run(60000);
    Grain const end = scene.grain_of(0);
    std::vector<WallReaction> const reactions = measure_walls(scene.particles, scene.walls, scene.wall_contacts);
    EXPECT_NEAR(-reactions[0].force.z / (mass_of(diameter) * gravity), 1, 1e-4);
    Real const radial = std::hypot(end.position.x, end.position.y);
    EXPECT_LT(radial, 1e-6);
    EXPECT_NEAR(end.position.z / std::sqrt(0.25e-6 - 0.09e-6), 1, 1e-3); // angle: sin = r/R = 0.6
    EXPECT_LT(norm(end.velocity), 1e-5);
}

TEST(VerifyWalls, GrainFallsThroughALargerHoleAndIsThrough)
{
    WallScene scene({grain({1e-4, 0, 1e-3}, diameter), grain({5e-3, 0, 0.5e-3}, diameter)}, {plate_with_hole(1.4e-3)},
                    sand());
    scene.start(2e-6, {0, 0, -gravity}, {open_hole()});
    scene.run(15000);
    Grain const falls = scene.grain_of(0), stays = scene.grain_of(1);
    EXPECT_NEAR(falls.velocity.z, -gravity * scene.time, 1e-9); // touched nothing
    EXPECT_NEAR(stays.position.z, 0.5e-3, 1e-6);
    WallBody const& body = scene.walls.body[0];
    auto const holes = Kokkos::create_mirror_view_and_copy(HostSpace(), scene.walls.views.hole);
    EXPECT_EQ(hole_passed(body.axis, holes, body.first_hole, body.holes, falls.position, 0.5e-3), 0);
    EXPECT_EQ(hole_passed(body.axis, holes, body.first_hole, body.holes, stays.position, 0.5e-3), -1);
}

TEST(VerifyWalls, GrainRollsOverTheRimAndFalls)
{
    // Slowly over the edge of a hole of four diameters: it turns about the rim, leaves it, falls through and
    // keeps its energy but for the damping, whichever way it hits the far side.
    WallScene scene({grain({-2.6e-3, 0, 0.49999e-3}, diameter, {0.05, 0, 0})}, {plate_with_hole(4e-3)}, sand(0.5));
    scene.start(2e-6, {0, 0, -gravity}, {open_hole()});
    Real lowest_speed = 1, most_energy = 0;
    Real const start_energy = mass_of(diameter) * gravity * 0.5e-3 + scene.kinetic_energy(2605);
    for (int n = 0; n < 400; ++n) {
        scene.run(100);
        Grain const g = scene.grain_of(0);
        Real const energy = scene.kinetic_energy(2605) + mass_of(diameter) * gravity * g.position.z;
        most_energy = std::max(most_energy, energy);
        if (g.position.z < -1e-3) break;
        lowest_speed = std::min(lowest_speed, norm(g.velocity));
    }
    Grain const end = scene.grain_of(0);
    EXPECT_LT(end.position.z, -1e-3);
    EXPECT_GT(lowest_speed, 0.02);
    EXPECT_LT(most_energy, start_energy * 1.001);
    EXPECT_GT(end.spin.y, 0);
}

TEST(VerifyWalls, GrainRollsFromACapAndEveryEdgeIsPassed)
{
    // Pushed over the top face of a solid box and a solid cylinder: falls beside them, no kick at the edge.
    WallSettings rod;
    rod.name = rod.material = "sand";
    rod.shape = WallShape::cylinder;
    rod.base = {0, 0, -5e-3};
    rod.axis = {0, 0, 5e-3};
    rod.diameter = 2e-3;
    for (WallSettings const& wall : {rod, box_wall({-1e-3, -1e-3, -5e-3}, {1e-3, 1e-3, 0}, false, "sand")}) {
        WallScene scene({grain({0.2e-3, 0, 0.49999e-3}, diameter, {0.05, 0, 0})}, {wall}, sand(0.5));
        scene.start(2e-6, {0, 0, -gravity});
        Real const start_energy = mass_of(diameter) * gravity * 0.5e-3 + scene.kinetic_energy(2605);
        for (int n = 0; n < 300; ++n) {
            scene.run(100);
            Grain const g = scene.grain_of(0);
            EXPECT_LT(scene.kinetic_energy(2605) + mass_of(diameter) * gravity * g.position.z, start_energy * 1.001);
            if (g.position.z < -2e-3) break;
        }
        Grain const end = scene.grain_of(0);
        EXPECT_LT(end.position.z, -2e-3);
        EXPECT_GT(end.position.x, 1.5e-3 - 1e-6);
        EXPECT_NEAR(end.position.y, 0, 1e-9);
    }
}

/// Validation H4: what a fast rod gives the grains, the plate gets, less what they keep.
TEST(VerifyWalls, MomentumOfAFastRodIsItsImpulse)
{
    std::vector<Grain> grains;
    for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b)
            for (int c = 0; c < 4; ++c)
                grains.push_back(grain({a * 1.02e-3 - 2.5e-3, b * 1.02e-3 - 2.5e-3, c * 1.02e-3 + 0.51e-3}, diameter));
    WallSettings rod;
    rod.name = "rod";
    rod.material = "sand";
    rod.shape = WallShape::cylinder;
    rod.base = {0, 0, 5e-3};
    rod.axis = {0, 0, 5e-3};
    rod.diameter = 1.7e-3;
    WallScene scene(grains, {plane({0, 0, 0}, {0, 0, 1}), rod}, sand(0.2, 0.8, 2e9));
    WallAction down;
    down.wall = "rod";
    down.velocity = Vec3{0, 0, -10};
    down.travel = 4e-3;
    Real const dt = 2e-7;
    scene.start(dt, {}, {down});
    EXPECT_EQ(tunnelling_walls(scene.walls, diameter / 2, dt), "");
    EXPECT_NE(tunnelling_walls(scene.walls, diameter / 2, 6e-6), "");
    Vec3 impulse;
    for (int n = 0; n < 3000; ++n) {
        scene.step();
        for (WallReaction const& r : measure_walls(scene.particles, scene.walls, scene.wall_contacts))
            impulse -= dt * r.force;
    }
    Vec3 momentum;
    Real most = 0;
    for (Grain const& g : download(scene.particles)) {
        momentum += mass_of(diameter) * g.velocity;
        most += mass_of(diameter) * norm(g.velocity);
    }
    EXPECT_GT(most, 0);
    // Leapfrog: the sum of dt F is the momentum but for half of the last step's force.
    std::vector<WallReaction> const last = measure_walls(scene.particles, scene.walls, scene.wall_contacts);
    for (WallReaction const& r : last) impulse += dt / 2 * r.force;
    EXPECT_LT(norm(momentum - impulse), 1e-10 * most);
    Grain const pushed = scene.grain_of(0);
    EXPECT_TRUE(std::isfinite(pushed.position.x));
    for (Grain const& g : download(scene.particles)) EXPECT_GT(g.position.z, 0.3e-3); // none went through the plate
}

} // namespace
} // namespace arenite
