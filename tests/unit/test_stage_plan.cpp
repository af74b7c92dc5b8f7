// SPDX-License-Identifier: MIT
// What is settled before a run: the time step of grains of several materials.
#include "apps/stage_plan.hpp"
#include "core/error.hpp"
#include "core/grain.hpp"
#include "io/scene_reader.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <gtest/gtest.h>

namespace {

using namespace arenite;

std::string material(std::string const& name, std::string const& density, std::string const& youngs_modulus)
{
    return "[materials." + name + "]\ndensity = " + density + "\nyoungs_modulus = " + youngs_modulus +
           "\npoissons_ratio = 0.3\nrestitution = 0.8\nfriction = 0.2\n";
}

std::string const sand = material("sand", "2605", "2e10"), rubber = material("rubber", "1000", "2e6");
std::string const small_sand = "0, 0, 0, 2e-4, sand\n", smaller_rubber = "5e-4, 0, 0, 1e-4, rubber\n";

/// Of the one stage of a scene with these materials and grains.
PlannedStage planned(std::string const& materials, std::string const& grains)
{
    test::ScratchFolder const folder;
    test::put(folder / "grains.csv", "x, y, z, diameter, material\n" + grains);
    Scene const scene = read_scene_text("[domain]\nlower = [-1e-3, -1e-3, -1e-3]\nupper = [1e-3, 1e-3, 1e-3]\n" + materials +
                                            "[particles]\nsource = \"file\"\nfile = \"grains.csv\"\n"
                                            "[[stages]]\nname = \"flight\"\nduration = 1e-5\ntime_step_fraction = 0.1\n"
                                            "contact = { law = \"hertz\" }\n",
                                        folder / "scene.toml");
    return make_stage_plan(scene).at(0);
}

TEST(StagePlan, TheStepSuitsTheMaterialThatNeedsTheShortest)
{
    Real const of_sand = planned(sand, small_sand).dt, of_rubber = planned(rubber, smaller_rubber).dt;
    ASSERT_GT(of_rubber, 10 * of_sand);
    EXPECT_EQ(planned(sand + rubber, small_sand + smaller_rubber).dt, of_sand);
    EXPECT_EQ(planned(rubber + sand, small_sand + smaller_rubber).dt, of_sand);
    EXPECT_EQ(planned(sand + rubber, smaller_rubber).dt, of_rubber) << "of a material that no grain is of";
}

TEST(StagePlan, TheSmallestGrainMayBeOfAnotherMaterial)
{
    TimeStepLimits const limits = planned(rubber + sand, small_sand + smaller_rubber).limits;
    EXPECT_EQ(limits.smallest_diameter, 1e-4);
    EXPECT_EQ(limits.smallest_mass, planned(rubber, smaller_rubber).limits.smallest_mass);
}

/// Stages as they stand in a scene, with a lid that comes down on grains of sand.
StagePlan plan_of(std::string const& stages, std::string const& extra = "")
{
    test::ScratchFolder const folder;
    test::put(folder / "grains.csv", "x, y, z, diameter, material\n" + small_sand + "4e-4, 0, 0, 2e-4, sand\n");
    std::string const plate = "[materials.plate]\nrigid = true\nrestitution = 0.8\nfriction = 0\n" + extra;
    Scene const scene =
        read_scene_text("[domain]\nlower = [-1e-3, -1e-3, -1e-3]\nupper = [1e-3, 1e-3, 1e-3]\n" + plate + sand +
                            "surface_energy = 1\n[[interactions]]\nmaterials = [\"plate\", \"sand\"]\nfriction = 0.1\n"
                            "surface_energy = 1\n"
                            "[[walls]]\nname = \"lid\"\ntype = \"plane\"\nmaterial = \"plate\"\npoint = [0, 0, 1e-3]\n"
                            "normal = [0, 0, -1]\n[particles]\nsource = \"file\"\nfile = \"grains.csv\"\n" +
                            stages,
                        folder / "scene.toml");
    return make_stage_plan(scene);
}

std::string stage(std::string const& name, std::string const& rest)
{
    return "[[stages]]\nname = \"" + name + "\"\nduration = 1e-5\ntime_step_fraction = 0.1\n" + rest + "\n";
}

std::string const pressing = "target_porosity = 0.4\nwalls = [{ wall = \"lid\", servo = { stress = 1e5, axis = [0, 0, -1], "
                             "max_speed = 0.1 } }]\n";

TEST(StagePlan, FrictionIsThatOfTheGrainsWhateverMaterialComesFirst)
{
    StagePlan const plan = plan_of(stage("press", "contact = { law = \"hertz\" }\n" + pressing));
    EXPECT_EQ(plan.at(0).grain_friction, 0.2);
    EXPECT_EQ(plan.at(0).strictest, 1);
}

TEST(StagePlan, AFastCompressionOfGivenGrainsGoesAsFarAsTheirVolumeLeaves)
{
    StagePlan const plan = plan_of(stage(
        "press", "kind = \"compression\"\ncontact = { law = \"jkr\" }\nwall_contact = { law = \"jkr\" }\n" + pressing));
    ASSERT_EQ(plan.size(), 3u);
    Real const solid = 2 * sphere_volume(1e-4), height = solid / (4e-6 * (1 - 0.43));
    EXPECT_NEAR(plan[0].settings.walls.at(0).travel.value_or(0), 2e-3 - height, 1e-15);
    for (auto const* pairs : {&plan[0].pairs, &plan[0].wall_pairs})
        for (PairConstants const& pair : *pairs) EXPECT_EQ(pair.surface_energy, 0) << "nothing sticks while it densifies";
    EXPECT_GT(plan[1].pair(1, 1).surface_energy, 0);
}

TEST(StagePlan, WhatBondsAtTheStartIsSettledByPair)
{
    std::string const jkr = "contact = { law = \"jkr\" }\n", modified = "contact = { law = \"modified_jkr\" }\n",
                      walls = "wall_contact = { law = \"modified_jkr\" }\n";
    StagePlan const plan = plan_of(stage("press", jkr) + stage("bond", modified + walls) + stage("on", modified + walls) +
                                   stage("again", modified + walls + "form_bonds = true\n"));
    auto const grains = [&](int row) { return plan.at(row).pair(1, 1).bonds_at_start; };
    auto const lid = [&](int row) { return plan.at(row).wall_pairs.at(1).bonds_at_start; };
    EXPECT_FALSE(grains(0));
    EXPECT_TRUE(grains(1) && lid(1));
    EXPECT_FALSE(grains(2) || lid(2)) << "they were bonded in the stage before";
    EXPECT_TRUE(grains(3) && lid(3));
    StagePlan const by_pair = plan_of(
        stage("bond", "contact = { law = \"hertz\" }\ninteractions = [{ materials = [\"sand\", \"sand\"], contact = { law = "
                      "\"modified_jkr\" } }]\n"));
    EXPECT_TRUE(by_pair.at(0).pair(1, 1).bonds_at_start);
    EXPECT_THROW(plan_of(stage("dry", "contact = { law = \"hertz\" }\nform_bonds = true\n")), InputError);
}

} // namespace
