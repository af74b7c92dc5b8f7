// SPDX-License-Identifier: MIT
// What one key may be: type, range, place, spelling.
#include "scene_text.hpp"

#include "io/scene_file.hpp"

using namespace arenite;
using namespace arenite::test;

namespace {

/// The paths of all values of a scene, as --set takes them.
void collect_paths(SceneNode const& node, std::string const& path, std::vector<std::string>& paths)
{
    std::string const prefix = path.empty() ? "" : path + ".";
    bool const list = !node.items.empty() && node.items[0].kind == SceneNode::Kind::table;
    for (std::size_t i = 0; list && i < node.items.size(); ++i)
        collect_paths(node.items[i], prefix + std::to_string(i), paths);
    for (SceneEntry const& entry : node.entries) collect_paths(entry.node, prefix + entry.key, paths);
    if (!list && node.kind != SceneNode::Kind::table) paths.push_back(path);
}

} // namespace

TEST(SceneValues, TheValidSceneHasNoFault) { EXPECT_EQ(faults_with({}), ""); }

TEST(SceneValues, OutOfRangeSaysPlaceKeyValueAndRange)
{
    EXPECT_EQ(faults_of_text("[domain]\nlower = [0, 0, 0]\nupper = [1, 1, 1]\n[materials.sand]\nyoungs_modulus = 2e10\n"
                             "poissons_ratio = 0.7\n[[stages]]\nname = \"a\"\nduration = 1\n"),
              "scenes/x.toml:6:18: materials.sand.poissons_ratio = 0.7: must be in (-1, 0.5)");
}

TEST(SceneValues, UnknownKeyNamesTheNearest)
{
    EXPECT_EQ(faults_of_text(valid_scene + "[outputs]\n"),
              "scenes/x.toml:129:2: outputs: unknown key; did you mean output?");
    EXPECT_TRUE(contains(faults_with({"materials.sand.frictoin=1"}),
                         "materials.sand.frictoin: unknown key; did you mean friction?"));
    EXPECT_TRUE(
        contains(faults_with({"stages.flow.contact.lwa=hertz"}), "stages.flow.contact.lwa: unknown key; did you mean law?"));
}

TEST(SceneValues, UnlikeKeyListsWhatThereIs)
{
    EXPECT_TRUE(contains(faults_with({"coarse_graining.zzzzzzzz=1"}), "unknown key; there is scheme, factor"));
}

TEST(SceneValues, WrongTypeSaysTypeAndUnit)
{
    EXPECT_TRUE(contains(faults_with({"materials.sand.density=heavy"}),
                         "materials.sand.density = \"heavy\": must be a number [kg/m3]"));
    EXPECT_TRUE(contains(faults_with({"domain.gravity=9.81"}), "domain.gravity = 9.81: must be a vector [x, y, z] [m/s2]"));
    EXPECT_TRUE(contains(faults_with({"domain.gravity=[0, 0]"}), "must be a vector [x, y, z] [m/s2]"));
    EXPECT_TRUE(contains(faults_with({"particles.distribution.count=10.5"}), "must be a whole number"));
    EXPECT_TRUE(contains(faults_with({"stages.flow.fluid=1"}), "stages.flow.fluid = 1: must be true or false"));
    EXPECT_TRUE(contains(faults_with({"domain=1"}), "domain = 1: must be a table"));
    EXPECT_TRUE(contains(faults_with({"walls=1"}), "walls = 1: must be a list of tables: write [[walls]]"));
    EXPECT_TRUE(contains(faults_with({"particles.distribution.diameters=[1e-3, big]"}), "not valid TOML"));
    EXPECT_TRUE(contains(faults_with({"fluid.cells=[1, 2]"}), "fluid.cells = [1, 2]: must be three whole numbers"));
}

TEST(SceneValues, AWholeNumberIsARealAndTheOtherWayRound)
{
    EXPECT_EQ(faults_with({"materials.sand.density=2605", "particles.distribution.count=1e2"}), "");
}

TEST(SceneValues, AClosedListPrintsItself)
{
    EXPECT_TRUE(contains(faults_with({"stages.flow.contact.law=herz"}),
                         "must be one of hertz, jkr, modified_jkr; did you mean hertz?"));
    EXPECT_TRUE(contains(faults_with({"fluid.drag=ergun"}), "must be one of none, di_felice, di_felice_literal, gidaspow"));
    EXPECT_TRUE(
        contains(faults_with({"output.grain_fields=[\"velosity\"]"}), "\"velosity\" is not known; did you mean velocity?"));
}

TEST(SceneValues, NotFiniteIsRefused)
{
    EXPECT_TRUE(contains(faults_with({"materials.sand.density=nan"}), "must be finite"));
    EXPECT_TRUE(contains(faults_with({"domain.upper=[inf, 1, 1]"}), "must be finite"));
}

TEST(SceneValues, RangesHold)
{
    EXPECT_TRUE(contains(faults_with({"particles.distribution.diameters=[-1e-4, 3e-4]"}), "must be > 0 m"));
    EXPECT_TRUE(contains(faults_with({"materials.sand.restitution=0"}), "must be in (0, 1]"));
    EXPECT_TRUE(contains(faults_with({"materials.sand.friction=-0.1"}), "must be >= 0"));
    EXPECT_TRUE(contains(faults_with({"coarse_graining.factor=0.5"}), "must be >= 1"));
    EXPECT_TRUE(contains(faults_with({"walls.rod.diameter=0"}), "must be > 0 m"));
    EXPECT_TRUE(contains(faults_with({"walls.top.holes.perforation.diameter=-1"}), "must be > 0 m"));
    EXPECT_TRUE(contains(faults_with({"fluid.density=0"}), "must be > 0 kg/m3"));
    EXPECT_TRUE(contains(faults_with({"fluid.cells=[0, 1, 1]"}), "must be in [1, 100000]"));
    EXPECT_TRUE(contains(faults_with({"random_seed=-1"}), "random_seed = -1: must be >= 0"));
    EXPECT_TRUE(contains(faults_with({"stages.press.time_step_fraction=2"}), "must be in [0, 1]"));
    EXPECT_TRUE(contains(faults_with({"groups.pushed.classes=[99999999999]"}), "is too large"));
}

TEST(SceneValues, MissingKeyIsAtItsTable)
{
    std::string const faults = faults_of_text(without(valid_scene, "youngs_modulus = 2e10\n"));
    EXPECT_EQ(faults, "scenes/x.toml:9:1: materials.sand: missing key youngs_modulus: a number [Pa], stiffness");
    EXPECT_TRUE(contains(faults_of_text(without(valid_scene, "lower = [0, 0, 0]\n")),
                         "scenes/x.toml:3:1: domain: missing key lower"));
    EXPECT_TRUE(contains(faults_of_text(without(valid_scene, "name = \"flow\"\n")), "missing key name"));
}

TEST(SceneValues, AKeyOfAnotherShapeHasNoMeaning)
{
    EXPECT_TRUE(contains(faults_with({"walls.rod.normal=[0, 0, 1]"}), "has no meaning here: only with type = \"plane\""));
    EXPECT_TRUE(contains(faults_with({"walls.rod.holes.0.name=x"}), "has no meaning here: only with type = \"plane\""));
    EXPECT_TRUE(contains(faults_with({"fluid.patches.0.pressure=1"}), "has no meaning here: only with type = \"pressure\""));
}

TEST(SceneValues, OneMistakeIsSaidOnce)
{
    EXPECT_EQ(faults_with({"fluid.time_step=-1"}), "--set fluid.time_step=-1: fluid.time_step = -1: must be >= 0 s");
    EXPECT_EQ(faults_with({"stages.flow.duration=x"}),
              "--set stages.flow.duration=x: stages.flow.duration = \"x\": must be a number [s]");
    EXPECT_EQ(faults_with({"materials.sand.density=-5"}),
              "--set materials.sand.density=-5: materials.sand.density = -5: must be >= 0 kg/m3");
}

TEST(SceneValues, AWrongValueOfAWholeSceneDoesNotDoubtItsNeighbours)
{
    std::vector<std::string> paths;
    collect_paths(parse_scene(valid_scene, "x.toml"), "", paths);
    EXPECT_GT(paths.size(), 80u);
    for (std::string const& path : paths) {
        std::string const faults = faults_with({path + "=1979-05-27"}); // no key takes a date
        EXPECT_TRUE(contains(faults, "--set " + path + "=1979-05-27: "));
        EXPECT_EQ(faults.find("has no meaning here"), std::string::npos) << faults;
        EXPECT_EQ(faults.find(": missing key youngs_modulus"), std::string::npos) << faults;
        EXPECT_EQ(faults.find(": missing key point"), std::string::npos) << faults;
    }
}

TEST(SceneValues, AControlCharacterDoesNotCutTheMessage)
{
    std::string const faults = faults_of_text("\"a\\u0000b\\nc\" = 1\ntitel = 2\n[stages]\n");
    EXPECT_TRUE(contains(faults, "scenes/x.toml:1:1: a\\u0000b\\u000ac: unknown key"));
    EXPECT_TRUE(contains(faults, "scenes/x.toml:2:1: titel: unknown key; did you mean title?"));
}

TEST(SceneValues, AllFaultsComeAtOnceInTheOrderOfTheFile)
{
    std::string text = valid_scene;
    text.replace(text.find("friction = 0.2"), 14, "friction = -1 ");
    text.replace(text.find("factor = 2"), 10, "facto  = 2");
    std::string const faults = faults_of_text(text, {"fluid.density=-1"});
    std::size_t const first = faults.find("--set fluid.density=-1: "),
                      second = faults.find("scenes/x.toml:14:12: materials.sand.friction"),
                      third = faults.find("scenes/x.toml:28:1: coarse_graining.facto: unknown key; did you mean factor?");
    EXPECT_LT(first, second);
    EXPECT_LT(second, third);
    EXPECT_NE(third, std::string::npos) << faults;
}
