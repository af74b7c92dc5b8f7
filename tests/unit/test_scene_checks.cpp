// SPDX-License-Identifier: MIT
// Whether the tables of a scene fit together: one wrong value, one message.
#include "scene_text.hpp"

using namespace arenite;
using namespace arenite::test;

namespace {

void expect_fault(std::vector<std::string> const& overrides, std::string const& piece)
{
    EXPECT_TRUE(contains(faults_with(overrides), piece));
}

} // namespace

TEST(SceneChecks, Domain)
{
    expect_fault({"domain.upper=[0.01, 0, 0.02]"}, "domain.upper = [0.01, 0, 0.02]: must be above lower along y");
}

TEST(SceneChecks, UnknownMaterial)
{
    expect_fault({"particles.material=sant"}, "there is no material \"sant\"; did you mean sand?");
    expect_fault({"walls.rod.material=iron"}, "walls.rod.material = \"iron\": there is no material \"iron\"");
    expect_fault({"stages.press.materials.sond.friction=1"}, "there is no material \"sond\"; did you mean sand?");
    expect_fault({"interactions.0.materials=[\"sand\", \"glass\"]"}, "there is no material \"glass\"");
}

TEST(SceneChecks, NothingIsMixedInSilence)
{
    std::string const needed = "sand and steel touch but differ in restitution (0.8 and 0.9): say what holds between them, "
                               "[[interactions]] materials = [\"sand\", \"steel\"], restitution = ...";
    expect_fault({"materials.steel.restitution=0.9"}, needed);
    EXPECT_EQ(faults_with({"materials.steel.restitution=0.9", "interactions.0.restitution=0.85"}), "");
    // A law that does not use the value does not need it.
    EXPECT_EQ(faults_with({"materials.steel.restitution=0.9", "stages.fill.wall_contact.damping=none",
                           "stages.flow.wall_contact.damping=none"}),
              "");
}

TEST(SceneChecks, AStageOverrideCanMakeAPairDiffer)
{
    std::string const text = without(valid_scene, "[[interactions]]\nmaterials = [\"sand\", \"steel\"]\nfriction = 0.15\n");
    std::string const faults = faults_of_text(text, {"materials.steel.friction=0.2"});
    EXPECT_TRUE(contains(faults, "stages.press.materials.sand: sand and steel touch but differ in friction (0.15 and 0.2)"));
    EXPECT_EQ(faults.find("stages.flow"), std::string::npos);
}

TEST(SceneChecks, GrainMaterialNeedsADensity)
{
    EXPECT_TRUE(
        contains(faults_of_text(without(valid_scene, "density = 2605\n")), "materials.sand: missing key density [kg/m3]"));
}

TEST(SceneChecks, Distribution)
{
    expect_fault({"particles.distribution.fractions=[0.4, 0.5]"}, "the sum must be 1, it is 0.9");
    EXPECT_EQ(faults_with({"particles.distribution.fractions=[0.4, 0.6000001]"}), "");
    expect_fault({"particles.distribution.fractions=[1]"}, "must have one value for each of the 2 diameters");
    expect_fault({"particles.distribution.diameters=[3e-4, 2e-4]"}, "must be ascending");
    expect_fault({"particles.distribution.solid_fraction=0.5"},
                 "needs exactly one of count, solid_volume and solid_fraction");
    expect_fault({"particles.distribution.region={lower=[0, 0, 0], upper=[1, 1, 1]}"}, "must lie in the domain");
    expect_fault({"particles.distribution.lognormal={median=2e-4, sigma=0.2, minimum=1e-4, maximum=3e-4}"},
                 "stands beside diameters or fractions");
    expect_fault({"stages.fill.kind=dynamics"}, "need a first stage of kind = \"generation\"");
}

TEST(SceneChecks, Files)
{
    expect_fault({"particles={source=\"file\", file=\"none.csv\", material=\"sand\"}"}, "there is no file scenes/none.csv");
    expect_fault({"walls.rod={name=\"rod\", type=\"mesh\", material=\"steel\", file=\"rod.stl\"}"},
                 "there is no file scenes/rod.stl");
}

TEST(SceneChecks, NamesThatNoFileCanHave)
{
    std::string const longer(5000, 'x');
    expect_fault({"particles={source=\"file\", file=\"" + longer + "\", material=\"sand\"}"}, "there is no file");
    expect_fault({"walls.rod={name=\"rod\", type=\"mesh\", material=\"steel\", file=\"" + longer + "\"}"},
                 "there is no file");
    expect_fault({"particles={source=\"checkpoint\", file=\"a\\u0000b\", material=\"sand\"}"}, "there is no file");
    EXPECT_THROW(read_scene(longer), InputError);
}

TEST(SceneChecks, AmountsThatNoComputerHolds)
{
    expect_fault({"fluid.cells=[100000, 100000, 1]"}, "are 6e+10 nodes with those of the boundary, more than the 7.16e+08");
    expect_fault({"particles.distribution.count=3e9"}, "is too large");
    expect_fault({"particles.distribution.count=0", "particles.distribution.solid_volume=1e9"},
                 "more than the 2147483647 that a run can have");
    expect_fault({"particles.distribution.diameters=[1e-200, 1e-199]"}, "mean volume is not a number");
    std::vector<std::string> materials;
    for (int n = 0; n < 254; ++n) materials.push_back("materials.m" + std::to_string(n) + ".rigid=true");
    expect_fault(materials, "materials: are 256, more than the 255");
}

TEST(SceneChecks, Groups)
{
    expect_fault({"groups.pushed.held=true", "groups.pushed.velocity=[0, 0, 1]"}, "a grain is held or moved");
    expect_fault({"groups.pushed.classes=[]"}, "chooses no grains");
    expect_fault({"groups.pushed.force=[0, 0, 0]"}, "does nothing");
    expect_fault({"groups.pushed.stages=[\"flov\"]"}, "there is no stage \"flov\"; did you mean flow?");
    expect_fault({"groups.pushed.spin=[0, 0, 1]"}, "needs velocity beside it");
}

TEST(SceneChecks, DuplicateNames)
{
    expect_fault({"stages.1.name=flow"}, "two entries have name = \"flow\"; the first is at scenes/x.toml:96:1");
    expect_fault({"walls.2.name=top"}, "walls.top: two entries have name = \"top\"");
    expect_fault({"walls.top.holes.1={name=\"perforation\", center=[0, 0, 0], diameter=1e-3}"},
                 "two entries have name = \"perforation\"");
    expect_fault({"interactions.1={materials=[\"steel\", \"sand\"], friction=0.1}"}, "an earlier entry names the same pair");
}

TEST(SceneChecks, Walls)
{
    expect_fault({"walls.top.normal=[0, 0, 0]"}, "must not be [0, 0, 0]");
    expect_fault({"walls.rod.axis=[0, 0, 0]"}, "must not be [0, 0, 0]");
    expect_fault({"walls.3={name=\"b\", type=\"box\", material=\"sand\", lower=[0, 0, 0], upper=[0, 1, 1]}"},
                 "must be above lower along x");
}

TEST(SceneChecks, OverlappingWalls)
{
    // A rod across the top plate beside its hole, and one through the hole.
    expect_fault({"walls.rod.present=true", "walls.rod.base=[0.002, 0.005, 0.015]"},
                 "walls.rod: overlaps wall top at the start");
    EXPECT_EQ(faults_with({"walls.rod.present=true", "walls.rod.base=[0.005, 0.005, 0.015]"}), "");
    // It may stand on the floor, not in it.
    EXPECT_EQ(faults_with({"walls.rod.present=true", "walls.rod.base=[0.002, 0.005, 0]"}), "");
    expect_fault({"walls.rod.present=true", "walls.rod.base=[0.002, 0.005, -0.001]"},
                 "walls.rod: overlaps wall floor at the start");
    expect_fault({"walls.top.normal=[0, 0, 1]", "walls.top.point=[1, 0, 0]"},
                 "walls.top: is the same plane as wall floor at the start");
    expect_fault({"walls.top.point=[0, 0, -0.001]"}, "walls.top: leaves no room between itself and wall floor at the start");
    std::string const block = "walls.3={name=\"block\", type=\"box\", material=\"sand\", lower=[0.004, 0.004, 0], "
                              "upper=[0.006, 0.006, 0.002]";
    EXPECT_EQ(faults_with({block + "}"}), "");
    expect_fault({block + "}", "walls.rod.present=true", "walls.rod.base=[0.005, 0.005, 0.001]"},
                 "walls.block: overlaps wall rod");
    expect_fault({block + ", inside=true}", "walls.rod.present=true", "walls.rod.base=[0.005, 0.005, 0.001]"},
                 "walls.block: overlaps wall rod");
}

TEST(SceneChecks, Fluid)
{
    expect_fault({"fluid.coupling_interval=100"}, "stands beside time_step: give one of them");
    expect_fault({"fluid.time_step=0"}, "missing key time_step [s] or coupling_interval [grain steps]");
    EXPECT_EQ(faults_with({"fluid.time_step=0", "fluid.coupling_interval=100"}), "");
    expect_fault({"fluid.fit_wall=rod"}, "must be a plane whose normal is along x, y or z");
    expect_fault({"fluid.fit_wall=tip"}, "there is no wall \"tip\"; did you mean top?");
    expect_fault({"stages.flow.time_step=3e-7"}, "fluid.time_step = 1e-06 must be a whole number of it, it is 3.33");
}

TEST(SceneChecks, PeriodicFacesComeInPairs)
{
    expect_fault({"fluid.patches.1.type=slip"}, "x_lower is periodic, so x_upper must be periodic too");
    expect_fault({"fluid.patches.0.type=slip", "fluid.patches.1.type=slip"},
                 "the domain is periodic along x: add [[fluid.patches]]");
    expect_fault({"fluid.patches.4={face=\"x_upper\", type=\"wall\"}"}, "x_upper is periodic and can carry no other patch");
    expect_fault({"fluid.patches.0={face=\"x_lower\", type=\"periodic\", shape=\"disc\", center=[0, 0, 0], diameter=1e-3}"},
                 "a periodic patch is the whole face");
}

TEST(SceneChecks, StageTime)
{
    expect_fault({"stages.flow.duration=0"}, "stages.flow: missing key duration [s]");
    expect_fault({"stages.flow.time_step=0"}, "stages.flow: missing key time_step [s] or time_step_fraction");
    expect_fault({"stages.press.time_step=1e-8"}, "stands beside time_step: give one of them");
    EXPECT_TRUE(contains(faults_of_text("[domain]\nlower = [0, 0, 0]\nupper = [1, 1, 1]\n"),
                         "scenes/x.toml:1:1: missing table [[stages]]"));
}

TEST(SceneChecks, StageActions)
{
    expect_fault({"stages.press.walls.top.wall=tob"}, "there is no wall \"tob\"; did you mean top?");
    expect_fault({"stages.flow.walls.top.open=[\"hole\"]"}, "there is no hole of wall top \"hole\"; there is perforation");
    expect_fault({"stages.flow.walls.top.open=[]"}, "no hole of it is open");
    expect_fault({"stages.flow.walls.1={wall=\"rod\", open=[\"x\"]}"}, "only a plane has holes");
    expect_fault({"stages.flow.walls.1={wall=\"rod\", velocity=[0, 0, -1]}"}, "moves a wall that is not there");
    EXPECT_EQ(faults_with({"stages.flow.walls.1={wall=\"rod\", present=true, velocity=[0, 0, -1]}"}), "");
    expect_fault({"stages.press.walls.top.velocity=[0, 0, 1]"}, "stands beside a velocity");
    expect_fault({"stages.press.walls.top.servo.force=3"}, "needs exactly one of stress and force");
    expect_fault({"stages.press.walls.top.travel=1"}, "needs a velocity that is not 0");
    expect_fault({"stages.press.walls.top.and_back=true"}, "needs travel");
    expect_fault({"stages.flow.outlet_wall=rod"}, "must be a plane");
}

TEST(SceneChecks, StageKinds)
{
    expect_fault({"stages.press.kind=generation"}, "generation must be the first stage");
    expect_fault({"stages.flow.kind=compression"}, "compression needs a wall with [stages.walls.servo]");
    expect_fault({"stages.press.fluid=true", "stages.press.kind=compression"}, "only a stage of kind dynamics has fluid");
}

TEST(SceneChecks, StageEnds)
{
    expect_fault({"stages.press.end.stress_wall=tob"}, "there is no wall \"tob\"");
    expect_fault({"stages.press.end.position_wall=rod", "stages.press.end.position=0"},
                 "the wall is not there in this stage");
    expect_fault({"stages.press.end.wall_travel_done=true"}, "no wall of this stage has a travel");
    expect_fault({"stages.flow.end.stress_wall=top"}, "stages.flow.end: missing key stress");
}

TEST(SceneChecks, PeriodicBox)
{
    EXPECT_EQ(faults_with({"stages.press.box.x.strain_rate=-0.1"}), "");
    expect_fault({"stages.press.box.z.strain_rate=-0.1"}, "the domain is not periodic along this axis");
    expect_fault({"stages.press.box.x.strain_rate=-0.1", "stages.press.carrier=top"}, "stands beside carrier");
    expect_fault({"stages.press.box.x.strain_rate=-0.1", "stages.press.kind=compression"},
                 "a stage of kind compression strains with its servo's wall");
    expect_fault({"stages.press.box.x.strain_rate=-0.1", "stages.press.fluid=true"}, "stands beside fluid = true");
    expect_fault({"stages.press.carrier=top", "stages.press.fluid=true"}, "stands beside carrier");
    expect_fault({"stages.press.box.x.stress=1e6"}, "missing key max_strain_rate [1/s]");
    expect_fault({"stages.press.box.x={stress=1e6, strain_rate=1}"}, "needs one of strain_rate and stress, not both");
}

TEST(SceneChecks, WhatWouldDoNothing)
{
    expect_fault({"stages.press.materials.sand.density=1000"}, "grains keep the mass that they were made with");
    expect_fault({"output.probes.middle.point=[1, 1, 1]"}, "lies outside the fluid's box");
    expect_fault({"fluid.viscosity=0", "fluid.drag=di_felice"}, "this drag law needs a Reynolds number");
}

TEST(SceneChecks, Output)
{
    expect_fault({"output.probes.first.point=[0, 0, 0]"}, "output.probes.first: needs exactly one of grain and point");
    expect_fault({"output.streamlines.count=0"}, "missing key count");
    expect_fault({"output.streamlines.disc_radius=1"}, "a disc needs disc_center, disc_normal and disc_radius");
}
