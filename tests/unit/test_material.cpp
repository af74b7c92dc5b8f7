// SPDX-License-Identifier: MIT
#include "apps/verify/materials.hpp"
#include "core/particles.hpp"

#include <gtest/gtest.h>

namespace arenite {
namespace {

constexpr Real rounding = 1e-14;

TEST(Material, PairOfUnlikeMaterials)
{
    MaterialSettings const a = make_material(2500, 2e10, 0.25), b = make_material(2700, 7e10, 0.3);
    PairConstants const pair = make_pair(a, b, contact_settings(NormalLaw::hertz));
    Real const shear_a = 2e10 / 2.5, shear_b = 7e10 / 2.6;
    EXPECT_NEAR(pair.effective_youngs_modulus * ((1 - 0.0625) / 2e10 + 0.91 / 7e10), 1, rounding);
    EXPECT_NEAR(pair.effective_shear_modulus * (1.75 / shear_a + 1.7 / shear_b), 1, rounding);
    EXPECT_EQ(pair.surface_energy, 0);
    EXPECT_EQ(pair.damping_factor, 0);
    PairConstants const swapped = make_pair(b, a, contact_settings(NormalLaw::hertz));
    EXPECT_NEAR(swapped.effective_youngs_modulus / pair.effective_youngs_modulus, 1, rounding);
}

TEST(Material, RigidSideDoesNotYield)
{
    MaterialSettings const soft = make_material(2500, 2e10, 0.25);
    MaterialSettings rigid = soft;
    rigid.rigid = true;
    PairConstants const pair = make_pair(soft, rigid, contact_settings(NormalLaw::hertz));
    EXPECT_NEAR(pair.effective_youngs_modulus * (1 - 0.0625) / 2e10, 1, rounding);
    EXPECT_NEAR(pair.effective_shear_modulus * 1.75 / (2e10 / 2.5), 1, rounding);
}

TEST(Material, DampingFollowsTheRestitution)
{
    EXPECT_EQ(damping_ratio(1), 0);
    EXPECT_NEAR(damping_ratio(0.8), 0.070850300195, 1e-11);
    EXPECT_NEAR(damping_ratio(0.5), 0.215453761966, 1e-11);
    PairConstants const pair =
        make_pair(with(sand(), 0.8, 0), with(sand(), 0.8, 0), contact_settings(NormalLaw::hertz, DampingLaw::restitution));
    EXPECT_NEAR(pair.damping_factor, 2 * std::sqrt(5.0 / 6) * 0.070850300195, 1e-10);
    EXPECT_FALSE(pair.clip_attraction);
}

TEST(Material, RayleighTimeGivesThePapersShare)
{
    // 1e-8 s is 4.402 % of it; with the printed G = E/(2(1-nu)) it would be 6.00 %.
    EXPECT_NEAR(1e-8 / rayleigh_time(sand(), 0.115e-3), 0.04402, 1e-5);
}

Scene two_materials()
{
    Scene scene;
    scene.materials = {with(sand(), 0.8, 0.2), with(sand(), 0.8, 0.2)};
    scene.materials[0].name = "sand";
    scene.materials[1].name = "clay";
    return scene;
}

TEST(Material, SurfaceEnergyScalesWithTheGrains)
{
    Scene scene = two_materials();
    scene.coarse_graining.factor = 2;
    StageSettings stage;
    stage.contact = contact_settings(NormalLaw::jkr);
    EXPECT_EQ(make_pair_constants(scene, stage, stage.contact)[0].surface_energy, 60);
}

TEST(Material, UnlikeSurfaceEnergiesDoNotAdhereUnlessNamed)
{
    Scene scene = two_materials();
    scene.materials[1].surface_energy = 10;
    scene.coarse_graining.factor = 2;
    StageSettings stage;
    stage.contact = contact_settings(NormalLaw::jkr);
    std::vector<PairConstants> pairs = make_pair_constants(scene, stage, stage.contact);
    EXPECT_EQ(pairs[0].surface_energy, 60);
    EXPECT_EQ(pairs[1].surface_energy, 0);
    EXPECT_EQ(pairs[3].surface_energy, 20);
    InteractionSettings named;
    named.materials = {"clay", "sand"};
    named.surface_energy = 5;
    scene.interactions = {named};
    pairs = make_pair_constants(scene, stage, stage.contact);
    EXPECT_EQ(pairs[1].surface_energy, 10);
    EXPECT_EQ(pairs[2].surface_energy, 10);
    EXPECT_EQ(pairs[0].surface_energy, 60);
}

TEST(Material, StageInteractionsReplaceTheScenes)
{
    Scene scene = two_materials();
    InteractionSettings named;
    named.materials = {"sand", "clay"};
    named.friction = 0.6;
    scene.interactions = {named};
    StageSettings stage;
    stage.contact = contact_settings(NormalLaw::hertz, DampingLaw::none, TangentialLaw::secant);
    EXPECT_EQ(make_pair_constants(scene, stage, stage.contact)[1].friction, 0.6);
    named.friction = 0.1;
    stage.interactions = {named};
    EXPECT_EQ(make_pair_constants(scene, stage, stage.contact)[1].friction, 0.1);
    EXPECT_EQ(make_pair_constants(scene, stage, stage.contact)[0].friction, 0.2);
    stage.interactions[0].friction.reset(); // complete: the scene's 0.6 does not show through
    EXPECT_EQ(make_pair_constants(scene, stage, stage.contact)[1].friction, 0.2);
}

TEST(Material, GrainsOfOneMaterialShareAPair)
{
    auto const grains_of = [](std::vector<int> const& materials) {
        std::vector<Grain> grains(materials.size());
        for (std::size_t n = 0; n < grains.size(); ++n) {
            grains[n].diameter = 2e-4;
            grains[n].material = materials[n];
        }
        return make_particles(grains, {2600, 2600});
    };
    EXPECT_EQ(shared_material(grains_of({1, 1, 1})), 1);
    EXPECT_EQ(shared_material(grains_of({1, 0, 1})), -1);
    EXPECT_EQ(shared_material(grains_of({})), -1);
    std::vector<PairConstants> const two_materials(4), one_material(1);
    EXPECT_EQ(upload(two_materials, 1).shared, 3);
    EXPECT_EQ(upload(two_materials, -1).shared, -1);
    EXPECT_EQ(upload(one_material).shared, 0);
}

} // namespace
} // namespace arenite
