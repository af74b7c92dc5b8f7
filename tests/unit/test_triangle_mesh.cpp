// SPDX-License-Identifier: MIT
#include "core/error.hpp"
#include "core/mesh_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace arenite {
namespace {

/// The box's surface, seen from outside (or from inside), two triangles a face.
std::vector<Triangle> box_mesh(Vec3 const& lower, Vec3 const& upper, bool inside)
{
    auto const corner = [&](int n) {
        return Vec3{n & 1 ? upper.x : lower.x, n & 2 ? upper.y : lower.y, n & 4 ? upper.z : lower.z};
    };
    int const faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    std::vector<Triangle> mesh;
    for (auto const& f : faces)
        for (int k : {1, 2}) {
            Triangle t{{corner(f[0]), corner(f[k]), corner(f[k + 1])}};
            if (inside) std::swap(t.corner[1], t.corner[2]);
            mesh.push_back(t);
        }
    return mesh;
}

std::vector<Triangle> sphere_mesh(int n)
{
    auto const at = [&](int a, int b) {
        Real const theta = std::numbers::pi * b / n, phi = std::numbers::pi * a / n;
        return Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    };
    std::vector<Triangle> mesh;
    for (int b = 0; b < n; ++b)
        for (int a = 0; a < 2 * n; ++a) {
            mesh.push_back({{at(a, b), at(a, b + 1), at(a + 1, b + 1)}}); // degenerate ones at the poles are dropped
            mesh.push_back({{at(a, b), at(a + 1, b + 1), at(a + 1, b)}});
        }
    return mesh;
}

struct Touch {
    int count = 0;
    WallProximity nearest;
};

/// What upload sends to the device, back on the host.
struct HostMesh {
    explicit HostMesh(MeshViews const& device)
        : triangle(Kokkos::create_mirror_view_and_copy(HostSpace(), device.triangle)),
          vertex(Kokkos::create_mirror_view_and_copy(HostSpace(), device.vertex)),
          edge_end(Kokkos::create_mirror_view_and_copy(HostSpace(), device.edge_end)),
          cell_begin(Kokkos::create_mirror_view_and_copy(HostSpace(), device.cell_begin)),
          cell_triangle(Kokkos::create_mirror_view_and_copy(HostSpace(), device.cell_triangle))
    {
    }
    View1<MeshTriangle>::HostMirror triangle;
    View1<MeshVertex>::HostMirror vertex;
    View1<int>::HostMirror edge_end, cell_begin, cell_triangle;
};

struct Mesh {
    MeshData data;
    MeshPart part;
    HostMesh views;
    explicit Mesh(std::vector<Triangle> const& triangles) : part(append_mesh(data, triangles, "mesh")), views(upload(data))
    {
    }
};

struct Collect { // a struct, as nvcc wants no lambda of the host in a function for both
    int* found;
    int* count;
    KOKKOS_FUNCTION void operator()(int triangle) const { found[(*count)++] = triangle; }
};

/// How many contacts a grain has with the mesh, and the deepest; by all triangles, not through the grid.
Touch touch(Mesh const& mesh, Vec3 const& x, Real radius)
{
    Touch result;
    result.nearest.distance = 1e300;
    for (int t = 0; t < mesh.part.triangles; ++t) {
        Real side = 0;
        WallProximity const p = wall_geometry::mesh_triangle(mesh.views, t, x, radius, side);
        if (!p.faces || p.distance >= radius) continue;
        ++result.count;
        if (p.distance < result.nearest.distance) result.nearest = p;
    }
    return result;
}

Real brute_distance(Mesh const& mesh, Vec3 const& x)
{
    Real least = 1e300;
    for (MeshTriangle const& t : mesh.data.triangles)
        least = std::min(least, norm(x - wall_geometry::nearest_on_triangle(t.corner, x)));
    return least;
}

TEST(TriangleMesh, ConvexBodiesTouchOnceAtTheNearestPoint)
{
    std::mt19937 random(2);
    std::uniform_real_distribution<Real> within(-1.6, 1.6);
    Mesh const box(box_mesh({-1, -0.5, -0.7}, {1, 0.5, 0.7}, false)), sphere(sphere_mesh(12));
    for (Mesh const* mesh : {&box, &sphere})
        for (int n = 0; n < 3000; ++n) {
            Vec3 const x{within(random), within(random), within(random)};
            if (mesh == &sphere ? norm(x) < 1 : wall_geometry::solid_box({1, 0.5, 0.7}, x).distance < 0) continue;
            Real const radius = 0.3, brute = brute_distance(*mesh, x);
            Touch const found = touch(*mesh, x, radius);
            ASSERT_EQ(found.count, brute < radius ? 1 : 0) << x.x << " " << x.y << " " << x.z;
            if (found.count) { ASSERT_NEAR(found.nearest.distance, brute, 1e-12); }
        }
}

TEST(TriangleMesh, DiagonalsEdgesAndCornersAreCountedOnce)
{
    Mesh const box(box_mesh({-1, -1, -1}, {1, 1, 1}, false));
    Real const radius = 0.1;
    EXPECT_EQ(touch(box, {0, 0, 1.05}, radius).count, 1);       // over the diagonal of a face
    EXPECT_EQ(touch(box, {0.25, 0.25, 1.05}, radius).count, 1); // on it again
    EXPECT_EQ(touch(box, {-0.25, 0.25, 1.05}, radius).count, 1);
    EXPECT_EQ(touch(box, {0, 1.05, 1.05}, radius).count, 1);    // an edge
    EXPECT_EQ(touch(box, {1, 0.3, 1.05}, radius).count, 1);     // exactly over an edge
    EXPECT_EQ(touch(box, {1, 1, 1.05}, radius).count, 1);       // exactly over a corner
    EXPECT_EQ(touch(box, {1.05, 1.05, 1.05}, radius).count, 1); // a corner
    EXPECT_NEAR(touch(box, {1.05, 1.05, 1.05}, radius).nearest.distance, 0.05 * std::sqrt(3.), 1e-14);
}

TEST(TriangleMesh, FlatSeamsAreTightInAnyDirection)
{
    // Points that rounding puts on one side of a turned seam or the other: one contact each, never none or two.
    std::mt19937 random(6);
    std::uniform_real_distribution<Real> unit(0, 1);
    for (int trial = 0; trial < 200; ++trial) {
        Vec3 const a = normalized(Vec3{unit(random), unit(random), unit(random)});
        Vec3 const b = normalized(cross(a, Vec3{unit(random), -unit(random), 1})), n = cross(a, b);
        Vec3 const p{unit(random), unit(random), unit(random)}, q = p + a, r = p + a + b, s = p + b;
        Mesh const square({{{p, q, r}}, {{p, r, s}}});
        for (int k = 0; k < 50; ++k) {
            Vec3 const x = p + unit(random) * (r - p) + 0.05 * unit(random) * n;
            EXPECT_EQ(touch(square, x, 0.1).count, 1);
        }
    }
}

TEST(TriangleMesh, ConcaveCornersTouchEveryFaceOnce)
{
    Mesh const box(box_mesh({-1, -1, -1}, {1, 1, 1}, true));
    Real const radius = 0.1;
    EXPECT_EQ(touch(box, {0, 0, -0.95}, radius).count, 1);
    EXPECT_EQ(touch(box, {0, -0.95, -0.95}, radius).count, 2);
    EXPECT_EQ(touch(box, {-0.95, -0.95, -0.95}, radius).count, 3);
}

TEST(TriangleMesh, InsideOfACurvedSurfaceTouchesOnce)
{
    std::vector<Triangle> mesh = sphere_mesh(24); // facets meet at 7.5 degrees
    for (Triangle& t : mesh) std::swap(t.corner[1], t.corner[2]);
    Mesh const ball(mesh);
    std::mt19937 random(3);
    std::normal_distribution<Real> normal;
    for (int n = 0; n < 1000; ++n) {
        Vec3 const x = 0.93 * normalized(Vec3{normal(random), normal(random), normal(random)});
        Touch const found = touch(ball, x, 0.1);
        EXPECT_GE(found.count, 1);
        EXPECT_LE(found.count, 2); // two only across a vertex, whose facets share no edge
        EXPECT_NEAR(found.nearest.distance, brute_distance(ball, x), 1e-12);
    }
}

TEST(TriangleMesh, GridFindsWhatAllTrianglesWould)
{
    Mesh const sphere(sphere_mesh(40)); // 6240 triangles
    EXPECT_EQ(sphere.part.triangles, 2 * 40 * 2 * 40 - 2 * 80);
    std::mt19937 random(4);
    std::uniform_real_distribution<Real> within(-1.3, 1.3);
    for (int n = 0; n < 200; ++n) {
        Vec3 const x{within(random), within(random), within(random)};
        Real const reach = 0.15;
        std::vector<int> list(4 * sphere.part.triangles);
        int count = 0;
        visit_near_triangles(sphere.views, sphere.part.grid, x, reach, Collect{list.data(), &count});
        std::multiset<int> const found(list.begin(), list.begin() + count);
        std::multiset<int> expected;
        for (int t = 0; t < sphere.part.triangles; ++t)
            if (norm(x - wall_geometry::nearest_on_triangle(sphere.data.triangles[t].corner, x)) < reach) expected.insert(t);
        EXPECT_EQ(found, expected);
    }
}

TEST(TriangleMesh, RefusesWhatIsNoSurface)
{
    MeshData data;
    EXPECT_THROW(append_mesh(data, {}, "empty"), InputError);
    Triangle const line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}};
    EXPECT_THROW(append_mesh(data, {line}, "line"), InputError);
    Triangle const broken{{{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}}};
    EXPECT_THROW(append_mesh(data, {broken}, "broken"), InputError);
}

} // namespace
} // namespace arenite
