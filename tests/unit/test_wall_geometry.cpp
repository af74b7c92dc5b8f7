// SPDX-License-Identifier: MIT
// Nearest points of walls against brute force: the distance to a dense sample of the surface.
#include "core/wall_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace arenite {
namespace {

using std::numbers::pi;

struct Sampled {
    std::vector<Vec3> points;
    Real spacing = 0; // no point of the surface is farther than this from a sample

    Real distance(Vec3 const& x) const
    {
        Real least = 1e300;
        for (Vec3 const& p : points) least = std::min(least, norm(x - p));
        return least;
    }
};

Sampled sample_cylinder(Real length, Real radius, bool caps, int n)
{
    Sampled s;
    s.spacing = 2 * std::max(length, radius) * pi / n;
    for (int a = 0; a < n; ++a) {
        Vec3 const out{std::cos(2 * pi * a / n), std::sin(2 * pi * a / n), 0};
        for (int k = 0; k <= n; ++k) s.points.push_back(radius * out + Vec3{0, 0, length * k / n});
        if (!caps) continue;
        for (int k = 0; k <= n; ++k)
            for (Real z : {Real(0), length}) s.points.push_back(radius * k / n * out + Vec3{0, 0, z});
    }
    return s;
}

Sampled sample_box(Vec3 const& half, int n)
{
    Sampled s;
    s.spacing = 2 * std::max({half.x, half.y, half.z}) / n * 1.5;
    for (int axis = 0; axis < 3; ++axis)
        for (int a = 0; a <= n; ++a)
            for (int b = 0; b <= n; ++b)
                for (int sign : {-1, 1}) {
                    Vec3 p;
                    p[axis] = sign * half[axis];
                    p[(axis + 1) % 3] = half[(axis + 1) % 3] * (2.0 * a / n - 1);
                    p[(axis + 2) % 3] = half[(axis + 2) % 3] * (2.0 * b / n - 1);
                    s.points.push_back(p);
                }
    return s;
}

std::vector<Vec3> random_points(int count, Real reach)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<Real> within(-reach, reach);
    std::vector<Vec3> points;
    for (int n = 0; n < count; ++n) points.push_back({within(random), within(random), within(random)});
    return points;
}

/// A sample overestimates the distance by spacing^2 / (2 distance) at most, and by spacing close to the surface.
void expect_nearest(WallProximity const& p, Vec3 const& x, Sampled const& surface)
{
    Real const brute = surface.distance(x), found = std::fabs(p.distance);
    EXPECT_LE(found, brute * (1 + 1e-12));
    EXPECT_GE(found, brute - surface.spacing);
    EXPECT_NEAR(norm(p.normal), 1, 1e-14);
    EXPECT_LT(surface.distance(x - p.distance * p.normal), surface.spacing); // the nearest point is on the surface
}

TEST(WallGeometry, RodIsNearestAtSurfaceCapAndRim)
{
    Sampled const surface = sample_cylinder(1.5, 0.7, true, 120);
    for (Vec3 const& x : random_points(300, 2)) {
        WallProximity const p = wall_geometry::rod({0, 0, 1}, 1.5, 0.7, x);
        expect_nearest(p, x, surface);
        bool const inside = x.z > 0 && x.z < 1.5 && std::hypot(x.x, x.y) < 0.7;
        EXPECT_EQ(p.distance < 0, inside);
    }
}

TEST(WallGeometry, TubeIsNearestOnItsShell)
{
    Sampled const surface = sample_cylinder(1.5, 0.7, false, 120);
    for (Vec3 const& x : random_points(300, 2)) {
        Real side = 0;
        expect_nearest(wall_geometry::tube({0, 0, 1}, 1.5, 0.7, x, 0.01, side), x, surface);
        EXPECT_EQ(side > 0, std::hypot(x.x, x.y) < 0.7);
    }
}

TEST(WallGeometry, SolidBoxIsNearestAtFaceEdgeAndCorner)
{
    Vec3 const half{0.5, 0.8, 0.3};
    Sampled const surface = sample_box(half, 60);
    for (Vec3 const& x : random_points(300, 1.5)) expect_nearest(wall_geometry::solid_box(half, x), x, surface);
    WallProximity const corner = wall_geometry::solid_box(half, {0.8, 1.2, 0.3 + 1.2});
    EXPECT_NEAR(corner.distance, 1.3, 1e-15); // 0.3, 0.4, 1.2
    EXPECT_NEAR(corner.normal.z, 1.2 / 1.3, 1e-15);
}

struct Holes {
    OpenHole holes[2];
    KOKKOS_FUNCTION OpenHole const& operator()(int h) const { return holes[h]; }
};

TEST(WallGeometry, PlateTouchesOnlyTheRimOverAHole)
{
    Holes const holes{{{{0.3, 0, 0}, 0.5}, {{-1, 0.5, 0}, 0.2}}};
    for (Vec3 const& x : random_points(2000, 1.5)) {
        Real side = 0, least = std::fabs(x.z);
        WallProximity const p = wall_geometry::plate({0, 0, 1}, holes, 0, 2, x, 0.01, side);
        for (OpenHole const& hole : holes.holes) {
            Real const radial = std::hypot(x.x - hole.center.x, x.y - hole.center.y);
            if (radial < hole.radius) least = std::hypot(radial - hole.radius, x.z);
        }
        EXPECT_NEAR(p.distance, least, 1e-14);
        EXPECT_EQ(side, x.z < 0 ? -1 : 1);
        Vec3 const foot = x - p.distance * p.normal;
        EXPECT_NEAR(foot.z, 0, 1e-14);
    }
}

TEST(WallGeometry, SheetsRememberTheSideAGrainCameFrom)
{
    Holes const holes{{{{0, 0, 0}, 1}, {}}};
    Real side = 1; // came from the front, its centre got behind the solid part
    WallProximity p = wall_geometry::plate({0, 0, 1}, holes, 0, 1, {2, 0, -0.01}, 0.1, side);
    EXPECT_EQ(p.normal, (Vec3{0, 0, 1}));
    EXPECT_DOUBLE_EQ(p.distance, -0.01);
    p = wall_geometry::plate({0, 0, 1}, holes, 0, 1, {0.5, 0, -0.01}, 0.1, side); // through the disc
    p = wall_geometry::plate({0, 0, 1}, holes, 0, 1, {1.5, 0, -0.05}, 0.1, side); // and aside, behind the plate
    EXPECT_EQ(p.normal, (Vec3{0, 0, -1}));
    EXPECT_DOUBLE_EQ(p.distance, 0.05);
}

TEST(WallGeometry, ALargeGrainIsHeldInTheMiddleOfAHole)
{
    // Distances to the near and the far side of the rim agree on the axis: the normal is the axis there, and
    // it turns smoothly as the grain moves aside.
    wall_geometry::AxialPosition position;
    position.height = 0.8;
    position.outward = {1, 0, 0};
    Real last = 0;
    for (Real radial : {0.0, 1e-6, 1e-4, 1e-2, 0.05, 0.1}) {
        position.radial = radial;
        Vec3 const normal = wall_geometry::rim_proximity(position, {0, 0, 1}, 0.5, 1).normal;
        EXPECT_NEAR(norm(normal), 1, 1e-15);
        EXPECT_LE(normal.x, last); // towards the axis, more so farther out
        last = normal.x;
        if (radial == 0) { EXPECT_DOUBLE_EQ(normal.z, 1); }
    }
}

TEST(WallGeometry, GrainsAreThroughWhenWhollyPastThePlate)
{
    Holes const holes{{{{0, 0, 0}, 1}, {{5, 0, 0}, 1}}};
    Vec3 const normal{0, 0, -1};                                         // grains are below the plate, they leave upwards
    EXPECT_EQ(hole_passed(normal, holes, 0, 2, {0, 0, 0.099}, 0.1), -1); // straddles
    EXPECT_EQ(hole_passed(normal, holes, 0, 2, {0, 0, 0.1}, 0.1), 0);
    EXPECT_EQ(hole_passed(normal, holes, 0, 2, {4.5, 0, 0.3}, 0.1), 1);
    EXPECT_EQ(hole_passed(normal, holes, 0, 2, {0, 0, -3}, 0.1), -1);
    EXPECT_EQ(hole_passed(normal, holes, 0, 0, {0, 0, 3}, 0.1), -1); // closed
}

TEST(WallGeometry, PosesTurnPointsAndBack)
{
    WallPose pose;
    pose.position = {1, 2, 3};
    Real const c = std::cos(0.3), s = std::sin(0.3);
    Real const turned[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
    std::copy(turned, turned + 9, pose.rotation);
    Vec3 const x{0.4, -0.2, 5};
    EXPECT_LT(norm(pose.to_world(pose.to_local(x)) - x), 1e-14);
    pose.angular_velocity = {0, 0, 2};
    pose.velocity = {0, 0, 1};
    EXPECT_EQ(pose.velocity_at({2, 2, 3}), (Vec3{0, 2, 1}));
}

} // namespace
} // namespace arenite
