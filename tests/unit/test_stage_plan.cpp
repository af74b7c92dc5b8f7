// SPDX-License-Identifier: MIT
// What is settled before a run: the time step of grains of several materials.
#include "apps/stage_plan.hpp"
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

} // namespace
