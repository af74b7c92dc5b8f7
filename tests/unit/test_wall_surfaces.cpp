// SPDX-License-Identifier: MIT
// Areas of the drawn walls.
#include "io/wall_surfaces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace arenite {
namespace {

using std::numbers::pi;
constexpr Real slack = 1e-7;         // the domain's, by which planes on its faces count as inside
constexpr Real circle_error = 0.003; // a polygon of 48 corners has 0.29 % less area than its circle

WallContext unit_domain()
{
    WallContext context;
    context.materials = {"steel"};
    context.upper = {1, 1, 1};
    return context;
}

WallSettings wall_of(WallShape shape)
{
    WallSettings wall;
    wall.name = "wall";
    wall.material = "steel";
    wall.shape = shape;
    return wall;
}

Vec3 corner_of(PolyPiece const& piece, std::int64_t i)
{
    Real const* const x = &piece.points[3 * piece.connectivity[i]];
    return {x[0], x[1], x[2]};
}

Real area_of(PolyPiece const& piece)
{
    Real area = 0;
    std::int64_t begin = 0;
    for (std::int64_t const end : piece.offsets) {
        Vec3 sum;
        for (std::int64_t i = begin + 1; i + 1 < end; ++i)
            sum += cross(corner_of(piece, i) - corner_of(piece, begin), corner_of(piece, i + 1) - corner_of(piece, begin));
        area += norm(sum) / 2;
        begin = end;
    }
    return area;
}

TEST(WallSurfaces, APlaneEndsAtTheDomain)
{
    WallSettings floor = wall_of(WallShape::plane), slanted = wall_of(WallShape::plane);
    slanted.name = "slanted";
    slanted.point = {0.5, 0.5, 0.5};
    slanted.normal = {1, 0, 1};
    EXPECT_NEAR(area_of(wall_surfaces(make_walls({floor}, unit_domain()), 0)), 1, slack);
    EXPECT_NEAR(area_of(wall_surfaces(make_walls({slanted}, unit_domain()), 0)), std::sqrt(2.0), slack);
}

TEST(WallSurfaces, OpenHolesAreCutOutAndClosedOnesAreNot)
{
    WallSettings plate = wall_of(WallShape::plane);
    plate.holes = {{"a", {0.3, 0.3, 0}, 0.4}, {"b", {0.8, 0.8, 0}, 0.2}, {"c", {0.2, 0.8, 0}, 0.1}};
    Walls walls = make_walls({plate}, unit_domain());
    EXPECT_NEAR(area_of(wall_surfaces(walls, 0)), 1, slack);
    WallAction action;
    action.wall = "wall";
    action.open = {"a", "b"};
    begin_stage(walls, {action});
    Real const holes = pi * (0.2 * 0.2 + 0.1 * 0.1);
    EXPECT_NEAR(area_of(wall_surfaces(walls, 0)), 1 - holes, circle_error * holes + slack);
    action.open = {"c"};
    begin_stage(walls, {action});
    EXPECT_NEAR(area_of(wall_surfaces(walls, 0)), 1 - holes - pi * 0.05 * 0.05, circle_error * 1.1 * holes + slack);
}

TEST(WallSurfaces, CylindersBoxesAndMeshesAreWhole)
{
    WallSettings rod = wall_of(WallShape::cylinder);
    rod.base = {0.5, 0.5, 0.1};
    rod.axis = {0, 0, 0.5};
    rod.diameter = 0.2;
    Real const side = pi * 0.2 * 0.5, caps = 2 * pi * 0.01;
    EXPECT_NEAR(area_of(wall_surfaces(make_walls({rod}, unit_domain()), 0)), side + caps, circle_error * (side + caps));
    rod.inside = true;
    EXPECT_NEAR(area_of(wall_surfaces(make_walls({rod}, unit_domain()), 0)), side, circle_error * side);

    WallSettings box = wall_of(WallShape::box);
    box.box = {{0.1, 0.1, 0.1}, {0.3, 0.4, 0.5}};
    EXPECT_NEAR(area_of(wall_surfaces(make_walls({box}, unit_domain()), 0)), 2 * (0.06 + 0.08 + 0.12), slack);

    WallSettings mesh = wall_of(WallShape::mesh);
    WallContext context = unit_domain();
    context.meshes["wall"] = {{{{0, 0, 0.5}, {1, 0, 0.5}, {0, 1, 0.5}}}, {{{1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5}}}};
    PolyPiece const piece = wall_surfaces(make_walls({mesh}, context), 0);
    EXPECT_EQ(piece.offsets.size(), 2u);
    EXPECT_NEAR(area_of(piece), 1, slack);
}

TEST(WallSurfaces, AbsentWallsAreNotDrawn)
{
    WallSettings floor = wall_of(WallShape::plane), box = wall_of(WallShape::box);
    floor.present = false;
    box.name = "box";
    box.box = {{0.1, 0.1, 0.1}, {0.3, 0.4, 0.5}};
    PolyPiece const piece = wall_surfaces(make_walls({floor, box}, unit_domain()), 3);
    EXPECT_EQ(piece.time, 3);
    EXPECT_EQ(std::get<std::vector<int>>(piece.cell_data.at(0).values), std::vector<int>(6, 1));
}

} // namespace
} // namespace arenite
