// SPDX-License-Identifier: MIT
// The scene in memory: defaults that follow from other keys, and the resolved scene that reads back equal.
#include "scene_text.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <numeric>

using namespace arenite;
using namespace arenite::test;

namespace {

Scene valid() { return read_scene_text(valid_scene, "scenes/x.toml"); }

std::vector<std::string> const lognormal{"particles.distribution={basis=\"number\", lognormal={median=2e-4, sigma=0.3, "
                                         "minimum=1e-4, maximum=4e-4, classes=6}, count=10}"};

} // namespace

TEST(SceneRoundTrip, ValuesArrive)
{
    Scene const scene = valid();
    EXPECT_EQ(scene.title, "a test");
    EXPECT_EQ(scene.random_seed, 7u);
    EXPECT_TRUE(scene.domain.periodic[0]);
    EXPECT_EQ(scene.materials[0].name, "sand");
    EXPECT_EQ(scene.materials[1].name, "steel");
    EXPECT_EQ(scene.coarse_graining.factor, 2);
    EXPECT_EQ(scene.walls[1].holes[0].diameter, 2.6e-3);
    EXPECT_EQ(scene.walls[2].shape, WallShape::cylinder);
    EXPECT_EQ(scene.fluid->patches[3].shape, PatchShape::disc);
    EXPECT_EQ(scene.fluid->patches[3].face, Face::z_upper);
    EXPECT_EQ(scene.stages[1].walls[0].servo->stress, 1e6);
    EXPECT_EQ(scene.output.probes[1].point->z, 0.005);
    EXPECT_EQ(scene.output.streamlines.line->upper.x, 0.01);
}

TEST(SceneRoundTrip, StageMaterialsInheritWhatTheyDoNotName)
{
    MaterialSettings const sand = valid().stages[1].materials.at("sand");
    EXPECT_EQ(sand.friction, 0.15);
    EXPECT_EQ(sand.youngs_modulus, 2e10);
    EXPECT_EQ(sand.surface_energy, 30);
}

TEST(SceneRoundTrip, StageInteractionsInheritWhatTheyDoNotName)
{
    InteractionSettings const pair = valid().stages[1].interactions[0];
    EXPECT_EQ(pair.restitution, 0.7);
    EXPECT_EQ(pair.friction, 0.15);
}

TEST(SceneRoundTrip, BreakPointFollowsTheLaw)
{
    Scene const scene = valid();
    EXPECT_EQ(scene.stages[1].contact.break_point, BreakPoint::S);
    EXPECT_EQ(scene.stages[2].contact.break_point, BreakPoint::C);
    Scene const named = read_scene_text(valid_scene, "x.toml", {"stages.press.contact.break_point=A"});
    EXPECT_EQ(named.stages[1].contact.break_point, BreakPoint::A);
}

TEST(SceneRoundTrip, LognormalBecomesClasses)
{
    DistributionSettings const d = read_scene_text(valid_scene, "x.toml", lognormal).particles.distribution;
    ASSERT_EQ(d.diameters.size(), 6u);
    EXPECT_FALSE(d.by_mass);
    EXPECT_NEAR(std::accumulate(d.fractions.begin(), d.fractions.end(), 0.0), 1, 1e-12);
    // The cuts lie symmetric about the median in ln(d), so the classes do too.
    EXPECT_NEAR(d.diameters[0] * d.diameters[5], 4e-8, 1e-20);
    EXPECT_NEAR(d.fractions[0], d.fractions[5], 1e-12);
    // Share within ln(2)/3 of the median, of what is within ln(2): erf ratios.
    Real const z = std::log(2.0) / 0.3 / std::sqrt(2.0);
    EXPECT_NEAR(d.fractions[2] + d.fractions[3], std::erf(z / 3) / std::erf(z), 1e-12);
}

TEST(SceneRoundTrip, TheResolvedSceneReadsBackEqual)
{
    for (std::vector<std::string> const& overrides :
         {std::vector<std::string>{},
          lognormal,
          {"title=\"quote \\\" backslash \\\\ tab\\t\"", "stages.press.box.x.strain_rate=-0.25",
           "groups.pushed.velocity=[1e-300, -0.0, 3]", "interactions.0.contact.law=jkr",
           "fluid.box={lower=[0, 0, 0], upper=[0.01, 0.01, 0.02]}"}}) {
        Scene const first = read_scene_text(valid_scene, "scenes/x.toml", overrides);
        Scene const second = read_scene_text(first.resolved, "scenes/x.toml");
        EXPECT_TRUE(first == second) << first.resolved;
        EXPECT_EQ(first.hash, second.hash);
    }
}

TEST(SceneRoundTrip, TheResolvedSceneShowsDefaultsAndUnits)
{
    std::string const resolved = valid().resolved;
    EXPECT_TRUE(contains(resolved, "viscosity = 0.001  # Pa s\n"));
    EXPECT_TRUE(contains(resolved, "friction_limit = \"thornton\"\n"));
    EXPECT_TRUE(contains(resolved, "# gravity is not set: the domain's\n"));
}

TEST(SceneRoundTrip, TheHashIsFnv1aAndMovesWithTheScene)
{
    EXPECT_EQ(hash_of(""), 0xcbf29ce484222325ull);
    EXPECT_EQ(hash_of("a"), 0xaf63dc4c8601ec8cull);
    EXPECT_NE(valid().hash, read_scene_text(valid_scene, "x.toml", {"random_seed=8"}).hash);
}

TEST(SceneRoundTrip, TheReferenceInTheDocsIsUpToDate)
{
    std::ifstream file(ARENITE_SOURCE_DIR "/docs/scene.md", std::ios::binary);
    std::string const text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::size_t const marker = text.find(scene_reference_marker);
    ASSERT_NE(marker, std::string::npos);
    EXPECT_EQ(text.substr(marker), scene_reference_marker + ("\n\n" + scene_reference()))
        << "build the target update_scene_reference";
}
