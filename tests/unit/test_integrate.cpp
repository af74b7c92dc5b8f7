// SPDX-License-Identifier: MIT
#include "apps/verify/packs.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace arenite {
namespace {

SystemSettings falling(std::vector<Grain> grains)
{
    SystemSettings settings;
    settings.grains = std::move(grains);
    settings.materials = {sand()};
    settings.skin = 1e-4;
    settings.dt = 1e-5;
    settings.gravity = {0, 0, -9.81};
    return settings;
}

TEST(Integrate, HeldGrainsStayAndPrescribedOnesKeepTheirMotion)
{
    std::vector<Grain> grains{make_grain(0, {0, 0, 0}, 1e-3, {1, 0, 0}, {5, 0, 0}),
                              make_grain(1, {1e-2, 0, 0}, 1e-3, {1, 0, 0}, {5, 0, 0}),
                              make_grain(2, {2e-2, 0, 0}, 1e-3, {1, 0, 0}, {5, 0, 0})};
    grains[0].motion = Motion::held;
    grains[1].motion = Motion::prescribed;
    GrainSystem system = make_system(falling(grains));
    advance(system, 100);
    std::vector<Grain> const after = grains_by_id(system);
    EXPECT_TRUE(after[0].position == Vec3{});
    EXPECT_NEAR(after[1].position.x, 1e-2 + 1e-3, 1e-16);
    EXPECT_EQ(after[1].position.z, 0);
    EXPECT_EQ(after[1].velocity.z, 0);
    EXPECT_NEAR(after[2].velocity.z, -9.81e-3, 1e-15);
    EXPECT_EQ(after[2].spin.x, 5);
    EXPECT_NEAR(force_on(system, 0).z, -9.81 * sphere_mass(sand(), 0.5e-3), 1e-20); // it feels forces
}

TEST(Integrate, ListIsStaleAfterHalfASkin)
{
    GrainSystem system = make_system(falling({make_grain(0, {0, 0, 0}, 1e-3, {1, 0, 0})}));
    advance(system, 4); // 4e-5 m of the allowed 5e-5
    EXPECT_EQ(system.rebuilds, 1);
    advance(system, 2);
    EXPECT_EQ(system.rebuilds, 2);
}

TEST(Integrate, TellsOfAVelocityThatIsNotANumber)
{
    // Alone in flight, no force ever sees it.
    SystemSettings settings = falling({make_grain(0, {0, 0, 0}, 1e-3), make_grain(1, {1, 0, 0}, 1e-3)});
    GrainSystem system = make_system(settings);
    place(system, 1, {1, 0, 0}, {std::numeric_limits<Real>::quiet_NaN(), 0, 0}, {});
    StepSettings step;
    step.dt = settings.dt;
    step.allowed_move = 1;
    drift(system.integrator, step, system.particles, system.contacts);
    EXPECT_TRUE(read_health(system.integrator) & force_is_not_finite);
}

TEST(Integrate, LocalDampingTakesFromWhatDrivesAndAddsToWhatBrakes)
{
    SystemSettings const settings =
        falling({make_grain(0, {0, 0, 0}, 1e-3, {0, 0, 1}), make_grain(1, {1, 0, 0}, 1e-3, {0, 0, -1})});
    GrainSystem system = make_system(settings);
    StepSettings step;
    step.dt = settings.dt;
    step.gravity = settings.gravity;
    step.local_damping = 0.7;
    kick(system.integrator, step, system.particles, system.contacts, {});
    Real const weight = 9.81 * sphere_mass(sand(), 0.5e-3);
    EXPECT_NEAR(force_on(system, 0).z / weight, -1.7, 1e-12); // rises, is braked more
    EXPECT_NEAR(force_on(system, 1).z / weight, -0.3, 1e-12);
}

TEST(Integrate, ADeformingBoxCarriesItsGrains)
{
    SystemSettings settings = falling({make_grain(0, {0.2e-2, 0.5e-2, 0.9e-2}, 1e-3)});
    settings.gravity = {};
    settings.box.upper = {1e-2, 1e-2, 1e-2};
    settings.box.strain_rate = {-10, 0, 20};
    for (bool& axis : settings.box.periodic) axis = true;
    GrainSystem system = make_system(settings);
    advance(system, 1000); // 1e-2 s
    Vec3 const place = grains_by_id(system)[0].position, size = system.settings.box.size();
    EXPECT_NEAR(size.x, 1e-2 * std::exp(-0.1), 1e-2 * 1e-5); // Euler steps of 1e-4
    EXPECT_NEAR(size.z, 1e-2 * std::exp(0.2), 1e-2 * 1e-4);
    EXPECT_NEAR(place.x / size.x, 0.2, 1e-12);
    EXPECT_NEAR(place.z / size.z, 0.9, 1e-12);
    EXPECT_TRUE(grains_by_id(system)[0].velocity == Vec3{}); // its own motion, without the flow
}

} // namespace
} // namespace arenite
