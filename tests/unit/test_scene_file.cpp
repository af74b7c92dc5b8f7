// SPDX-License-Identifier: MIT
// Places, syntax errors and --set, before any key has a meaning.
#include "scene_text.hpp"

#include "io/scene_file.hpp"

using namespace arenite;
using namespace arenite::test;

namespace {

std::string override_fault(std::string const& assignment)
{
    SceneNode root = parse_scene("a = 1\n[[list]]\nname = \"one\"\n[[list]]\nname = \"two\"\n", "f.toml");
    try {
        apply_override(root, assignment);
    } catch (InputError const& error) {
        return error.what();
    }
    return "";
}

SceneNode overridden(std::string const& assignment)
{
    SceneNode root = parse_scene("[[stages]]\nname = \"one\"\n[[stages]]\nname = \"two\"\ntime_step = 1\n", "f.toml");
    apply_override(root, assignment);
    return root;
}

} // namespace

TEST(SceneFile, EveryValueKnowsItsLineAndColumn)
{
    SceneNode const root = parse_scene("a = 1\n\n[b]\n  c = [1,\n 2.5]\n", "f.toml");
    EXPECT_EQ(root.find("a")->location.text, "f.toml:1:5");
    SceneNode const& c = *root.find("b")->find("c");
    EXPECT_EQ(c.location.text, "f.toml:4:7");
    EXPECT_EQ(c.items[1].location.text, "f.toml:5:2");
    EXPECT_EQ(root.find("b")->entries[0].location.text, "f.toml:4:3");
}

TEST(SceneFile, KeepsTheOrderOfTheFile)
{
    SceneNode const root = parse_scene("z = 1\na = 2\nm = 3\n", "f.toml");
    ASSERT_EQ(root.entries.size(), 3u);
    EXPECT_EQ(root.entries[0].key, "z");
    EXPECT_EQ(root.entries[2].key, "m");
}

TEST(SceneFile, SyntaxErrorHasAPlace)
{
    EXPECT_TRUE(contains(faults_of_text("title = \"x\"\n[domain\n"), "scenes/x.toml:2:"));
    EXPECT_TRUE(contains(faults_of_text("a = 1\na = 2\n"), "scenes/x.toml:2:5: not valid TOML"));
}

TEST(SceneFile, MissingFileIsAnInputError) { EXPECT_THROW(read_scene("there/is/none.toml"), InputError); }

TEST(SceneFile, OverrideTakesAnyTomlValue)
{
    EXPECT_EQ(overridden("x=2").find("x")->integer, 2);
    EXPECT_EQ(overridden("x=2e-3").find("x")->real, 2e-3);
    EXPECT_EQ(overridden("x=true").find("x")->boolean, true);
    EXPECT_EQ(overridden("x=[1, 2]").find("x")->items.size(), 2u);
    EXPECT_EQ(overridden("x={ y = 3 }").find("x")->find("y")->integer, 3);
    EXPECT_EQ(overridden("x=\"a b\"").find("x")->text, "a b");
}

TEST(SceneFile, OverrideTakesABareWordAsText)
{
    EXPECT_EQ(overridden("x=hertz").find("x")->text, "hertz");
    EXPECT_EQ(overridden("x=a=b").find("x")->text, "a=b");
    EXPECT_EQ(overridden("x=2mm.csv").find("x")->text, "2mm.csv");
}

TEST(SceneFile, OverrideMakesTablesAndLists)
{
    EXPECT_EQ(overridden("a.b.c=1").find("a")->find("b")->find("c")->integer, 1);
    EXPECT_EQ(overridden("list.0.c=1").find("list")->items[0].find("c")->integer, 1);
}

TEST(SceneFile, OverrideNamesAnElementByIndexOrName)
{
    EXPECT_EQ(overridden("stages.1.time_step=5").find("stages")->items[1].find("time_step")->integer, 5);
    EXPECT_EQ(overridden("stages.one.time_step=5").find("stages")->items[0].find("time_step")->integer, 5);
    EXPECT_EQ(overridden("stages.2.name=new").find("stages")->items.size(), 3u);
}

TEST(SceneFile, WrongOverrideSaysWhy)
{
    EXPECT_EQ(override_fault("a"), "--set a: must be table.key=value");
    EXPECT_EQ(override_fault("list.three.x=1"),
              "--set list.three.x=1: list has no element 'three'; there are 0 (one), 1 (two)");
    EXPECT_EQ(override_fault("list.7.x=1"), "--set list.7.x=1: list has no element '7'; there are 0 (one), 1 (two)");
    EXPECT_EQ(override_fault("a.b=1"), "--set a.b=1: a = 1 is not a table");
    EXPECT_EQ(override_fault("a=[1,"), "--set a=[1,: the value is not valid TOML");
    EXPECT_EQ(override_fault("a..b=1"), "--set a..b=1: the key has an empty part");
}

TEST(SceneFile, FaultOfAnOverrideNamesTheOverride)
{
    EXPECT_EQ(faults_with({"materials.sand.friction=x"}),
              "--set materials.sand.friction=x: materials.sand.friction = \"x\": must be a number");
}

TEST(SceneFile, OverridesReachTheScene)
{
    Scene const scene = read_scene_text(valid_scene, "x.toml", {"stages.flow.time_step=2e-8", "stages.1.contact.law=hertz"});
    EXPECT_EQ(scene.stages[2].time_step, 2e-8);
    EXPECT_EQ(scene.stages[1].contact.normal, NormalLaw::hertz);
}
