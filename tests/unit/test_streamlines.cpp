// SPDX-License-Identifier: MIT
// Streamlines in flows whose lines are known.
#include "io/field_output.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/vtk_read.hpp"

#include <cmath>
#include <functional>

namespace arenite {
namespace {

constexpr Real rounding = 1e-12;      // of numbers of size 1
constexpr Real point_rounding = 1e-7; // VTK's tracer keeps points of size 1 in single precision

FluidSnapshot flow_in_unit_box(int cells, std::function<Vec3(Vec3)> const& velocity)
{
    FluidSnapshot fluid;
    Real const size = Real(1) / cells;
    for (int& count : fluid.cells) count = cells;
    fluid.spacing = {size, size, size};
    for (int k = 0; k < cells; ++k)
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) {
                Vec3 const u = velocity({(i + 0.5) * size, (j + 0.5) * size, (k + 0.5) * size});
                fluid.velocity.insert(fluid.velocity.end(), {u.x, u.y, u.z});
            }
    std::size_t const count = fluid.velocity.size() / 3;
    fluid.pressure.assign(count, 0);
    fluid.porosity.assign(count, 1);
    return fluid;
}

std::vector<Vec3> points_of(PolyPiece const& lines)
{
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < lines.points.size(); i += 3)
        points.push_back({lines.points[i], lines.points[i + 1], lines.points[i + 2]});
    return points;
}

TEST(Streamlines, AreStraightThroughTheBoxInAUniformFlow)
{
    auto const fluid = flow_in_unit_box(8, [](Vec3) { return Vec3{2e-6, 0, 0}; }); // slow, as seepage is
    StreamlineSettings settings;
    settings.points = {{0.5, 0.3, 0.7}};
    auto const both = trace_streamlines(fluid, settings);
    ASSERT_EQ(both.offsets.size(), 2u); // one each way
    Real lowest = 1, highest = 0;
    for (Vec3 const& point : points_of(both)) {
        EXPECT_NEAR(point.y, 0.3, point_rounding);
        EXPECT_NEAR(point.z, 0.7, point_rounding);
        lowest = std::min(lowest, point.x);
        highest = std::max(highest, point.x);
    }
    Real const last_step = 0.5 * std::sqrt(3.0) / 8; // half a cell diagonal: the step that would leave the box is not made
    EXPECT_LT(lowest, last_step);
    EXPECT_GT(highest, 1 - last_step);
    ASSERT_EQ(both.point_data.size(), 2u);
    for (Real const speed : std::get<std::vector<Real>>(both.point_data[1].values)) EXPECT_NEAR(speed, 2e-6, 1e-18);
    for (Vec3 const& point : points_of(trace_streamlines(fluid, settings, TraceDirection::downstream)))
        EXPECT_GE(point.x, 0.5 - point_rounding);
    for (Vec3 const& point : points_of(trace_streamlines(fluid, settings, TraceDirection::upstream)))
        EXPECT_LE(point.x, 0.5 + point_rounding);
}

TEST(Streamlines, KeepTheirRadiusInARigidRotation)
{
    auto const fluid = flow_in_unit_box(16, [](Vec3 r) { return Vec3{-(r.y - 0.5), r.x - 0.5, 0}; });
    StreamlineSettings settings;
    settings.points = {{0.75, 0.5, 0.5}};
    settings.max_length = 2 * 3.14159265358979 * 0.25; // once around
    auto const line = trace_streamlines(fluid, settings, TraceDirection::downstream);
    ASSERT_EQ(line.offsets.size(), 1u);
    auto const points = points_of(line);
    for (Vec3 const& point : points) EXPECT_NEAR(std::hypot(point.x - 0.5, point.y - 0.5), 0.25, 0.01 * 0.25);
    EXPECT_LT(norm(points.back() - points.front()), 0.05); // closed
    EXPECT_GT(points[points.size() / 4].y, 0.6);           // and turning the right way
}

TEST(Streamlines, NothingToTraceIsAValidFile)
{
    test::ScratchFolder const folder;
    StreamlineSettings settings;
    settings.points = {{7, 7, 7}}; // outside
    auto const moving = flow_in_unit_box(4, [](Vec3) { return Vec3{1, 0, 0}; });
    auto const still = flow_in_unit_box(4, [](Vec3) { return Vec3{}; });
    FieldOutput output(folder.path());
    output.write_streamlines(moving, settings);
    for (auto const& lines :
         {trace_streamlines(moving, settings), trace_streamlines(still, settings), trace_streamlines(moving, {})})
        EXPECT_EQ(lines.offsets.size(), 0u);
    auto const found = test::read_poly(folder / "streamlines/streamlines_000000.vtp");
    EXPECT_TRUE(found.opened);
    EXPECT_EQ(found.lines, 0);
    EXPECT_EQ(found.points, 0);
}

TEST(Streamlines, AreFoundByVtkWithSpeedAndVelocity)
{
    test::ScratchFolder const folder;
    auto fluid = flow_in_unit_box(8, [](Vec3) { return Vec3{0, 3, 4}; });
    fluid.time = 2.5;
    StreamlineSettings settings;
    settings.line = Region{{0.2, 0.2, 0.5}, {0.8, 0.2, 0.5}};
    settings.count = 5;
    FieldOutput(folder.path()).write_streamlines(fluid, settings);
    auto const found = test::read_poly(folder / "streamlines/streamlines_000000.vtp");
    ASSERT_TRUE(found.opened);
    EXPECT_EQ(found.lines, 10); // both ways
    EXPECT_EQ(found.field_data.at("TimeValue").values, std::vector<double>{2.5});
    EXPECT_EQ(found.point_data.at("velocity").values.size(), 3 * std::size_t(found.points));
    for (double const speed : found.point_data.at("speed").values) EXPECT_NEAR(speed, 5, rounding * 5);
}

TEST(StreamlineSeeds, LieOnTheLineAndEvenlyOnTheDisc)
{
    StreamlineSettings settings;
    settings.points = {{1, 2, 3}};
    settings.line = Region{{0, 0, 0}, {1, 0, 0}};
    settings.disc_center = Vec3{0, 0, 1};
    settings.disc_normal = Vec3{0, 0, 5};
    settings.disc_radius = 2;
    settings.count = 100;
    auto const seeds = streamline_seeds(settings);
    ASSERT_EQ(seeds.size(), 201u);
    EXPECT_EQ(seeds[1], (Vec3{0, 0, 0}));
    EXPECT_EQ(seeds[100], (Vec3{1, 0, 0}));
    int inner = 0;
    for (std::size_t i = 101; i < seeds.size(); ++i) {
        EXPECT_DOUBLE_EQ(seeds[i].z, 1);
        EXPECT_LE(norm(seeds[i] - Vec3{0, 0, 1}), 2);
        inner += norm(seeds[i] - Vec3{0, 0, 1}) < std::sqrt(2.0) ? 1 : 0;
    }
    EXPECT_EQ(inner, 50); // half of the area, half of the seeds
}

} // namespace
} // namespace arenite
