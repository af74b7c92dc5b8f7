// SPDX-License-Identifier: MIT
// VTK's own readers open what was written and find what went in.
#include "io/field_output.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/vtk_read.hpp"

#include <cmath>
#include <regex>

namespace arenite {
namespace {

namespace fs = std::filesystem;
using test::contains;
using test::content_of;
using test::FoundFile;

Particles three_grains()
{
    std::vector<Grain> grains(3);
    for (int i = 0; i < 3; ++i) {
        grains[i].position = {0.1 * i, 1, 2};
        grains[i].diameter = 0.01 * (i + 1);
        grains[i].velocity = {1.0 * i, 0, -1};
        grains[i].spin = {0, 5, 0};
        grains[i].size_class = 2 - i;
        grains[i].id = (std::int64_t(1) << 40) + i;
    }
    return make_particles(grains, {2650});
}

GrainCounts counts_of_three()
{
    GrainCounts counts{View1<int>("bonds", 3), View1<int>("coordination", 3)};
    Kokkos::deep_copy(counts.bonds, 2);
    Kokkos::deep_copy(counts.coordination, 6);
    return counts;
}

void expect_three_grains(FoundFile const& found)
{
    ASSERT_TRUE(found.opened);
    EXPECT_EQ(found.points, 3);
    EXPECT_EQ(found.verts, 3);
    EXPECT_EQ(found.coordinates, (std::vector<double>{0, 1, 2, 0.1, 1, 2, 0.2, 1, 2}));
    EXPECT_EQ(found.field_data.at("TimeValue").values, std::vector<double>{0.125});
    auto const& data = found.point_data;
    EXPECT_EQ(data.at("diameter").values, (std::vector<double>{0.01, 0.02, 0.03}));
    EXPECT_EQ(data.at("velocity").components, 3);
    EXPECT_EQ(data.at("velocity").values, (std::vector<double>{0, 0, -1, 1, 0, -1, 2, 0, -1}));
    EXPECT_EQ(data.at("spin").values, (std::vector<double>{0, 5, 0, 0, 5, 0, 0, 5, 0}));
    EXPECT_EQ(data.at("class").type, "int");
    EXPECT_EQ(data.at("class").values, (std::vector<double>{2, 1, 0}));
    EXPECT_EQ(data.at("material").values, (std::vector<double>{0, 0, 0}));
    EXPECT_EQ(data.at("id").values, (std::vector<double>{1099511627776, 1099511627777, 1099511627778}));
    EXPECT_EQ(data.at("bonds").values, (std::vector<double>{2, 2, 2}));
    EXPECT_EQ(data.at("coordination").values, (std::vector<double>{6, 6, 6}));
    EXPECT_EQ(data.count("fluid_force"), 0u); // there is no fluid
}

TEST(FieldOutput, GrainsAreFoundByVtk)
{
    test::ScratchFolder const folder;
    FieldOutput output(folder.path());
    output.write(take_snapshot(three_grains(), 0.125, counts_of_three()));
    expect_three_grains(test::read_poly(folder / "particles/particles_000000.vtp"));
}

TEST(FieldOutput, GrainsFromThePlainWriterAreTheSame)
{
    test::ScratchFolder const folder;
    auto const piece = grain_piece(take_snapshot(three_grains(), 0.125, counts_of_three()));
    test::put(folder / "plain.vtp", encode_plain(piece));
    expect_three_grains(test::read_poly(folder / "plain.vtp"));
}

TEST(FieldOutput, NoGrainsAreAValidFile)
{
    test::ScratchFolder const folder;
    auto const piece = grain_piece(take_snapshot(make_particles({}, {2650}), 1));
    test::put(folder / "vtk.vtp", encode(piece));
    test::put(folder / "plain.vtp", encode_plain(piece));
    for (char const* name : {"vtk.vtp", "plain.vtp"}) {
        FoundFile const found = test::read_poly(folder / name);
        EXPECT_TRUE(found.opened) << name;
        EXPECT_EQ(found.points, 0) << name;
    }
}

TEST(FieldOutput, OnlyChosenFieldsAreWritten)
{
    auto const snapshot = take_snapshot(three_grains(), 0);
    auto const piece = grain_piece(snapshot, {"velocity", "bonds"}); // bonds are not known
    ASSERT_EQ(piece.point_data.size(), 1u);
    EXPECT_EQ(piece.point_data[0].name, "velocity");
    auto const message = test::message_of<InputError>([&] { grain_piece(snapshot, {"speeed"}); });
    EXPECT_TRUE(contains(message, "no grain field 'speeed'"));
    EXPECT_TRUE(contains(message, "coordination"));
    for (auto const& name : OutputSettings().grain_fields) EXPECT_NO_THROW(grain_piece(snapshot, {name})) << name;
    for (auto const& name : OutputSettings().fluid_fields) EXPECT_NO_THROW(fluid_piece(FluidSnapshot(), {name})) << name;
}

/// Velocity (x-face index, 0, 10 k), pressure i + 10 j + 100 k, porosity 0.5; NaN in the halo.
Flow small_flow()
{
    Flow flow;
    flow.grid.cells[0] = 4;
    flow.grid.cells[1] = 3;
    flow.grid.cells[2] = 2;
    flow.grid.lower = {-1, 0, 5};
    flow.grid.spacing = {0.5, 1, 2};
    for (auto& component : flow.velocity) component = flow.grid.make_field("u");
    flow.pressure = flow.grid.make_field("p");
    flow.porosity = flow.grid.make_field("n");
    auto const u = Kokkos::create_mirror_view(flow.velocity[0]), w = Kokkos::create_mirror_view(flow.velocity[2]);
    auto const p = Kokkos::create_mirror_view(flow.pressure), n = Kokkos::create_mirror_view(flow.porosity);
    Kokkos::deep_copy(p, std::nan(""));
    int const h = Grid::halo;
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 5; ++i) {
                u(i + h, j + h, k + h) = i;
                w(i + h, j + h, k + h) = 10 * k;
                n(i + h, j + h, k + h) = 0.5;
                if (i < 4 && j < 3 && k < 2) p(i + h, j + h, k + h) = i + 10 * j + 100 * k;
            }
    Kokkos::deep_copy(flow.velocity[0], u);
    Kokkos::deep_copy(flow.velocity[2], w);
    Kokkos::deep_copy(flow.pressure, p);
    Kokkos::deep_copy(flow.porosity, n);
    return flow;
}

void expect_small_flow(FoundFile const& found)
{
    ASSERT_TRUE(found.opened);
    EXPECT_EQ(found.cells, 24);
    EXPECT_EQ(found.bounds, (std::array<double, 6>{-1, 1, 0, 3, 5, 9}));
    EXPECT_EQ(found.field_data.at("TimeValue").values, std::vector<double>{0.25});
    auto const &velocity = found.cell_data.at("velocity"), &pressure = found.cell_data.at("pressure");
    EXPECT_EQ(velocity.components, 3);
    ASSERT_EQ(velocity.values.size(), 72u);
    ASSERT_EQ(pressure.values.size(), 24u);
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 4; ++i) {
                int const cell = i + 4 * (j + 3 * k); // i fastest
                EXPECT_EQ(pressure.values[cell], i + 10 * j + 100 * k);
                EXPECT_EQ(velocity.values[3 * cell], i + 0.5);
                EXPECT_EQ(velocity.values[3 * cell + 1], 0);
                EXPECT_EQ(velocity.values[3 * cell + 2], 10 * k + 5);
                EXPECT_DOUBLE_EQ(found.cell_data.at("speed").values[cell], std::hypot(i + 0.5, 10 * k + 5));
                EXPECT_EQ(found.cell_data.at("porosity").values[cell], 0.5);
            }
}

TEST(FieldOutput, FluidIsFoundByVtk)
{
    test::ScratchFolder const folder;
    FieldOutput output(folder.path());
    output.write(take_snapshot(small_flow(), 0.25));
    expect_small_flow(test::read_image(folder / "fluid/fluid_000000.vti"));
    test::put(folder / "plain.vti", encode_plain(fluid_piece(take_snapshot(small_flow(), 0.25))));
    expect_small_flow(test::read_image(folder / "plain.vti"));
}

std::vector<std::string> listed(fs::path const& pvd)
{
    std::vector<std::string> result;
    std::string const content = content_of(pvd);
    std::regex const entry("timestep=\"([^\"]*)\" file=\"([^\"]*)\"");
    for (std::sregex_iterator match(content.begin(), content.end(), entry), end; match != end; ++match)
        result.push_back((*match)[1].str() + " " + (*match)[2].str());
    return result;
}

void write_at(FieldOutput& output, std::initializer_list<double> times)
{
    for (double const time : times) output.write(take_snapshot(three_grains(), time));
}

TEST(FieldOutput, TheSeriesListsItsTimesAndSurvivesAResume)
{
    test::ScratchFolder const folder;
    FieldOutput first(folder.path());
    write_at(first, {0, 0.1 + 0.2, 0.5, 0.75});
    EXPECT_FALSE(fs::exists(folder / "fluid.pvd")); // no fluid, no series
    FieldOutput resumed(folder.path(), ResumePoint{10, 0.1 + 0.2, ""});
    EXPECT_FALSE(fs::exists(folder / "particles/particles_000003.vtp")); // of a future that is not ours
    write_at(resumed, {0.6});
    std::vector<std::string> const expected{"0 particles/particles_000000.vtp",
                                            "0.30000000000000004 particles/particles_000001.vtp",
                                            "0.6 particles/particles_000002.vtp"};
    EXPECT_EQ(listed(folder / "particles.pvd"), expected);
    for (auto const& line : expected) EXPECT_TRUE(test::read_poly(folder / line.substr(line.find(' ') + 1)).opened);
    FieldOutput const fresh(folder.path());
    EXPECT_FALSE(fs::exists(folder / "particles.pvd"));
    EXPECT_TRUE(fs::is_empty(folder / "particles"));
}

TEST(FieldOutput, ASecondStateOfTheSameTimeReplacesTheFirst)
{
    test::ScratchFolder const folder;
    FieldOutput output(folder.path());
    write_at(output, {0, 1, 1});
    EXPECT_EQ(listed(folder / "particles.pvd"),
              (std::vector<std::string>{"0 particles/particles_000000.vtp", "1 particles/particles_000002.vtp"}));
    EXPECT_FALSE(fs::exists(folder / "particles/particles_000001.vtp"));
}

TEST(FieldOutput, NothingOutsideTheSeriesIsDeleted)
{
    test::ScratchFolder const folder;
    test::put(folder / "precious.vtp", "x");
    test::put(folder / "particles.pvd",
              "<DataSet timestep=\"9\" file=\"precious.vtp\"/>\n<DataSet timestep=\"9\" file=\"../precious.vtp\"/>\n");
    FieldOutput const fresh(folder.path());
    EXPECT_TRUE(fs::exists(folder / "precious.vtp"));
}

TEST(FieldOutput, AFullDiskNamesThePieceAndListsNothing)
{
    test::ScratchFolder const folder;
    FieldOutput output(folder.path());
    write_at(output, {0});
    fs::create_symlink("/dev/full", folder / "particles/particles_000001.vtp.unfinished");
    auto const message = test::message_of<OutputError>([&] { write_at(output, {1}); });
    EXPECT_TRUE(contains(message, "particles_000001.vtp"));
    EXPECT_TRUE(contains(message, "No space left on device"));
    EXPECT_EQ(listed(folder / "particles.pvd").size(), 1u);
}

} // namespace
} // namespace arenite
