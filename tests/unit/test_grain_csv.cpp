// SPDX-License-Identifier: MIT
#include "scene_text.hpp"

#include <cstdio>
#include <fstream>

using namespace arenite;
using namespace arenite::test;

namespace {

/// A file that is there while the test runs.
struct TemporaryCsv {
    std::string path;

    explicit TemporaryCsv(std::string const& text)
        : path(testing::TempDir() + "arenite_" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv")
    {
        std::ofstream(path, std::ios::binary) << text;
    }
    ~TemporaryCsv() { std::remove(path.c_str()); }
};

std::vector<std::string> const materials{"sand", "steel"};

GrainTable read(std::string const& text, int default_material = 0)
{
    TemporaryCsv const csv(text);
    return read_grain_csv(csv.path, materials, default_material);
}

std::string fault(std::string const& text, int default_material = 0)
{
    try {
        read(text, default_material);
    } catch (InputError const& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(GrainCsv, ReadsEveryColumnInAnyOrder)
{
    GrainTable const table = read("# two grains\n\nid,diameter,x,y,z,vx,vy,vz,wx,wy,wz,fx,fy,fz,material,class,held\r\n"
                                  "7, 2e-3, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, steel, 3, 1\r\n"
                                  "# between\n8,1e-3,0,0,0,0,0,0,0,0,0,0,0,0,sand,0,false");
    ASSERT_EQ(table.grains.size(), 2u);
    Grain const& grain = table.grains[0];
    EXPECT_EQ(grain.id, 7);
    EXPECT_EQ(grain.diameter, 2e-3);
    EXPECT_TRUE(grain.position == (Vec3{1, 2, 3}));
    EXPECT_TRUE(grain.velocity == (Vec3{4, 5, 6}));
    EXPECT_TRUE(grain.spin == (Vec3{7, 8, 9}));
    EXPECT_TRUE(grain.applied_force == (Vec3{10, 11, 12}));
    EXPECT_EQ(grain.material, 1);
    EXPECT_EQ(grain.size_class, 3);
    EXPECT_EQ(grain.motion, Motion::held);
    EXPECT_EQ(table.grains[1].motion, Motion::free);
    EXPECT_EQ(table.lines[1], 6);
}

TEST(GrainCsv, RadiusIsHalfADiameter) { EXPECT_EQ(read("x,y,z,radius\n0,0,0,0.5").grains[0].diameter, 1); }

TEST(GrainCsv, UnknownColumnNamesTheNearest)
{
    EXPECT_TRUE(contains(fault("x,y,z,diametr\n"), ":1:4: unknown column \"diametr\"; did you mean diameter?"));
}

TEST(GrainCsv, ColumnsThatMustBeThere)
{
    EXPECT_TRUE(contains(fault("x,y,diameter\n"), ":1: column \"z\" is missing"));
    EXPECT_TRUE(contains(fault("x,y,z\n"), "there must be one of the columns diameter and radius"));
    EXPECT_TRUE(contains(fault("x,y,z,radius,diameter\n"), "there must be one of the columns diameter and radius"));
    EXPECT_TRUE(contains(fault("x,x,y,z,radius\n"), ":1:2: column \"x\" occurs twice"));
    EXPECT_TRUE(contains(fault("x,y,z,radius\n", -1), "neither a column material nor particles.material"));
    EXPECT_TRUE(contains(fault(""), "no line that names the columns"));
}

TEST(GrainCsv, FaultsComeTogetherWithTheirLines)
{
    std::string const text =
        fault("x,y,z,diameter,id\n0,0,0,-1e-3,0\n0,0,zero,1e-3,1\n0,0,0\n0,0,0,1e-3,1\n0,nan,0,1e-3,1.5\n");
    EXPECT_TRUE(contains(text, ":2:4: diameter = -1e-3: must be > 0 m"));
    EXPECT_TRUE(contains(text, ":3:3: z = zero: must be a finite number"));
    EXPECT_TRUE(contains(text, ":4: 3 values for 5 columns"));
    EXPECT_TRUE(contains(text, ":5: id 1 occurs twice"));
    EXPECT_TRUE(contains(text, ":6:2: y = nan: must be a finite number"));
    EXPECT_TRUE(contains(text, ":6:5: id = 1.5: must be a whole number"));
}

TEST(GrainCsv, MaterialAndHeldAreChecked)
{
    EXPECT_TRUE(contains(fault("x,y,z,radius,material\n0,0,0,1,sant\n"),
                         "material = sant: is not a material of the scene; did you mean sand?"));
    EXPECT_TRUE(contains(fault("x,y,z,radius,held\n0,0,0,1,yes\n"), "held = yes: must be 0 or 1"));
}

TEST(GrainCsv, ADiameterThatIsTooLargeForANumberIsRefused)
{
    EXPECT_TRUE(contains(fault("x,y,z,radius\n0,0,0,1e308\n"), "radius = 1e308: is too large"));
}

TEST(GrainCsv, GarbageIsRefusedEarly)
{
    EXPECT_TRUE(contains(fault(std::string(1 << 20, '\0')), "the line is longer than 4096 characters"));
    std::string many = "x,y,z,radius\n";
    for (int i = 0; i < 1000; ++i) many += "a,b,c,d\n";
    EXPECT_TRUE(contains(fault(many), "were not looked at"));
}

TEST(GrainCsv, FaultsOfTheFileBecomeFaultsOfTheScene)
{
    TemporaryCsv const csv("x,y,z,diameter\n0,0,0,0\n5,0,0,1e-3\n");
    std::string const scene =
        "[domain]\nlower = [-1, -1, -1]\nupper = [1, 1, 1]\n[materials.sand]\ndensity = 2605\nyoungs_modulus = -1\n"
        "poissons_ratio = 0.3\n[particles]\nsource = \"file\"\nmaterial = \"sand\"\nfile = \"" +
        csv.path + "\"\n[[stages]]\nname = \"a\"\nduration = 1\ntime_step = 1e-8\n";
    std::string const faults = faults_of_text(scene);
    EXPECT_TRUE(contains(faults, "materials.sand.youngs_modulus = -1: must be > 0 Pa"));
    EXPECT_TRUE(contains(faults, csv.path + ":2:4: diameter = 0: must be > 0 m"));
}

TEST(GrainCsv, AGrainOutsideTheDomainIsAFault)
{
    TemporaryCsv const csv("x,y,z,diameter\n5,0,0,1e-3\n");
    std::string const scene =
        "[domain]\nlower = [-1, -1, -1]\nupper = [1, 1, 1]\n[materials.sand]\ndensity = 2605\nyoungs_modulus = 1e9\n"
        "poissons_ratio = 0.3\n[particles]\nsource = \"file\"\nmaterial = \"sand\"\nfile = \"" +
        csv.path + "\"\n[[stages]]\nname = \"a\"\nduration = 1\ntime_step = 1e-8\n";
    EXPECT_EQ(faults_of_text(scene), csv.path + ":2: the grain's centre is outside the domain");
}
