// SPDX-License-Identifier: MIT
// The tangential law without kernels: transport, slip of rigid turns, limits, and the work of shear cycles.
#include "apps/verify/materials.hpp"
#include "kernels/contact/contact_laws.hpp"

#include <gtest/gtest.h>

namespace arenite {
namespace {

TEST(Tangential, TransportKeepsTheLengthAndThePlane)
{
    Vec3 const before = normalized({1, 2, 3});
    Vec3 const spring = 1e-7 * normalized(cross(before, {0, 0, 1}));
    for (Real const angle : {1e-9, 1e-4, 0.5, 2.0}) {
        Vec3 const after =
            normalized(before + std::tan(angle / 2) * (normalized(cross(before, {1, 0, 0})) + 0.3 * normalized(spring)));
        Vec3 const carried = transport_spring(spring, before, after, 0);
        EXPECT_NEAR(norm(carried) / norm(spring), 1, 1e-14);
        EXPECT_NEAR(dot(carried, after) / norm(spring), 0, 1e-14);
        Vec3 const back = transport_spring(carried, after, before, 0);
        EXPECT_NEAR(norm(back - spring) / norm(spring), 0, 1e-14);
    }
}

TEST(Tangential, TwistTurnsTheSpringAboutTheNormal)
{
    Vec3 const normal{0, 0, 1}, spring{1e-7, 0, 0};
    Vec3 const turned = transport_spring(spring, normal, normal, 1e-3);
    EXPECT_NEAR(turned.x / 1e-7, std::cos(1e-3), 1e-15);
    EXPECT_NEAR(turned.y / 1e-7, std::sin(1e-3), 1e-15);
}

TEST(Tangential, RigidTurnDoesNotSlip)
{
    constexpr Real dt = 1e-8, distance = 0.23e-3;
    for (Real const angle : {1e-4, 1e-3, 1e-2}) { // by series, and by roots
        Vec3 const axis = normalized({0.6, -0.3, 0.8}), before = normalized({1, 2, 3});
        Real const c = std::cos(angle), s = std::sin(angle);
        Vec3 const after = c * before + s * cross(axis, before) + ((1 - c) * dot(axis, before)) * axis;
        Vec3 const spin = (angle / dt) * axis;
        StraightTurn<Real> const step =
            straight_turn(distance * after, 1 / (distance * distance), (distance / dt) * (after - before), dt);
        Vec3 const slip = slip_over(step, spin, Real(0.5) * step.twice_cosine * cayley_factor(2 * spin, dt));
        // The series of the tangent leaves angle^5 / 120; the difference of the normals leaves its rounding.
        EXPECT_LT(norm(slip) * dt / distance, std::pow(angle, 5) / 100 + 1e-15);
    }
}

TEST(Tangential, SlipIsWhatIsAcrossTheMeanNormalSeenAcrossTheNew)
{
    constexpr Real dt = 1e-8;
    Vec3 const line{0.12e-3, -0.15e-3, 0.08e-3}, rolling{3e4, -1e4, 2e4};
    Vec3 const normal = normalized(line);
    for (Real const speed : {1e-3, 1.0, 30.0, 3000.0}) {
        Vec3 const approach = speed * normalized({1, 0.3, -0.7}), before = normalized(line - dt * approach);
        Vec3 const mean = contact_turn(before, normal).mean;
        Vec3 const slip = approach - (dot(approach, mean) / dot(mean, mean)) * mean - cross(rolling, norm(line) * mean);
        Vec3 const expected = slip - dot(slip, normal) * normal;
        Vec3 const found = slip_over(straight_turn(line, 1 / dot(line, line), approach, dt), rolling, Real(1));
        EXPECT_LT(norm(found - expected), 4e-15 * (speed + norm(rolling) * norm(line))) << speed;
    }
}

TEST(Tangential, StraightStepTurnsTheNormalAsItsEndsSay)
{
    constexpr Real dt = 1e-8;
    Vec3 const line{0.12e-3, -0.15e-3, 0.08e-3};
    Real const distance = norm(line);
    Vec3 const normal = normalized(line);
    for (Real const share :
         {0.0, 1e-9, 1e-5, 9e-5, 1.1e-4, 1.9e-3, 2.1e-3, 0.4, 1.0, 1.7, 4.0}) // of the distance, in the step
        for (Vec3 const& way : {normal, Real(-1) * normal, normalized({1, 1, 0}), normalized({-1, 2, 0.5})}) {
            Vec3 const approach = (share * distance / dt) * way, before = line - dt * approach;
            bool const followed = dot(before, normal) > 0; // centres that passed each other have no turn to follow
            LineTurn<Real> const expected = contact_turn(followed ? normalized(before) : normal, normal);
            StraightTurn<Real> const step = straight_turn(line, 1 / dot(line, line), approach, dt);
            EXPECT_NEAR(norm(step.turn.mean / distance - expected.mean), 0, 2e-15) << share;
            EXPECT_NEAR(step.twice_cosine, 1 + dot(followed ? normalized(before) : normal, normal), 2e-15) << share;
        }
}

TEST(Tangential, StraightStepOfConcentricGrains)
{
    Vec3 const line{0, 0, 1e-30}; // as the pair kernel names it
    for (Real const away : {0.0, 0.02}) {
        StraightTurn<Real> const step = straight_turn(line, Real(1e60), {0.1, 0, away}, 1e-8);
        EXPECT_TRUE(step.turn.mean == line);
        EXPECT_EQ(step.twice_cosine, 2);
        EXPECT_NEAR(step.parting * 1e30, away, 1e-16);
        EXPECT_LT(norm(slip_over(step, {}, Real(1)) - Vec3{0.1, 0, 0}), 1e-16);
    }
}

PairConstants rough_pair(TangentialLaw law, FrictionLimit limit = FrictionLimit::thornton)
{
    ContactSettings settings = contact_settings(NormalLaw::modified_jkr, DampingLaw::none, law);
    settings.friction_limit = limit;
    return make_pair(with(sand(), 1, 0.2), with(sand(), 1, 0.2), settings);
}

TEST(Tangential, LimitsByName)
{
    NormalResponse<> dry, adhering;
    adhering.pull_off_force = 3;
    PairConstants const thornton = rough_pair(TangentialLaw::secant),
                        paper = rough_pair(TangentialLaw::secant, FrictionLimit::paper);
    EXPECT_DOUBLE_EQ(friction_limit(thornton, dry, Real(10)), 2);
    EXPECT_DOUBLE_EQ(friction_limit(thornton, dry, Real(-10)), 0);
    EXPECT_DOUBLE_EQ(friction_limit(thornton, adhering, Real(0)), 0.2 * 6); // a bonded grain at rest carries shear
    EXPECT_DOUBLE_EQ(friction_limit(thornton, adhering, Real(-3)), 0.2 * 3);
    EXPECT_DOUBLE_EQ(friction_limit(paper, adhering, Real(0)), 0);
    EXPECT_DOUBLE_EQ(friction_limit(paper, adhering, Real(-3)), 0.2 * 3);
    EXPECT_DOUBLE_EQ(friction_limit(paper, dry, Real(-3)), 0);
}

/// Work [k_high xi^2] that shearing by xi at one overlap, changing the overlap and shearing back takes.
Real cycle_work(TangentialLaw law, bool shear_while_pressed)
{
    constexpr Real low = 1e-8, high = 4e-8, slip = 1e-12; // contact radii 1 : 2
    PairConstants pair = rough_pair(law);
    pair.friction = 1e9; // sticks
    ContactScale<> const scale = contact_scale(sand(), 0.115e-3, 0.115e-3);
    Real const out = shear_while_pressed ? high : low, back = shear_while_pressed ? low : high;
    ContactState<> state;
    Real work = 0;
    auto const move = [&](Real overlap, Real distance) {
        Real const before = -CementedSand{}({{0, 0, 1}, overlap, {}, scale}, pair, state, 1).x;
        Real const after = -CementedSand{}({{0, 0, 1}, overlap, {0, {distance, 0, 0}}, scale}, pair, state, 1).x;
        work += (before + after) / 2 * distance;
    };
    move(out, slip);
    move(back, -slip);
    Real const stiffness = 8 * pair.effective_shear_modulus * hertz_response(high, scale.effective_radius, 1).contact_radius;
    return work / (stiffness * slip * slip);
}

// k(high) = 2 k(low). A closed cycle that gives work back (< 0) makes energy from nothing.
TEST(Tangential, WorkOfShearCycles)
{
    constexpr Real rounding = 1e-10;
    EXPECT_NEAR(cycle_work(TangentialLaw::secant, true), 0.25, rounding);   // (k_high - k_low) / 2
    EXPECT_NEAR(cycle_work(TangentialLaw::secant, false), -0.25, rounding); // makes energy
    EXPECT_NEAR(cycle_work(TangentialLaw::incremental, false), 0.25, rounding);
    EXPECT_NEAR(cycle_work(TangentialLaw::incremental, true), -0.25, rounding); // makes energy, and keeps a force
    EXPECT_GT(cycle_work(TangentialLaw::rescaled, true), 0.25);
    EXPECT_NEAR(cycle_work(TangentialLaw::rescaled, false), -0.25, rounding);   // rescales on unloading only
    EXPECT_NEAR(cycle_work(TangentialLaw::dissipative, true), 0.25, rounding);  // as secant
    EXPECT_NEAR(cycle_work(TangentialLaw::dissipative, false), 0.25, rounding); // as incremental
}

TEST(Tangential, DryPairsFeelTheSameUnderEveryLaw)
{
    PairConstants const pair = make_pair(with(sand(), 0.8, 0.2), with(sand(), 0.8, 0.2),
                                         contact_settings(NormalLaw::hertz, DampingLaw::restitution, TangentialLaw::secant));
    Vec3 const normal = normalized({1, 1, 0});
    ContactGeometry<> const contact{normal, 1e-7, surface_motion({0.1, 0.3, -0.2}, normal),
                                    contact_scale(sand(), 1e-4, 2e-4)};
    ContactState<> dry, cemented;
    EXPECT_TRUE(DrySand{}(contact, pair, dry, 1e-8) == CementedSand{}(contact, pair, cemented, 1e-8));
    EXPECT_TRUE(dry.spring == cemented.spring);
}

TEST(Tangential, TheMenuPicksTheCheapestLaw)
{
    PairConstants smooth, rough, sticky;
    rough.friction = 0.2;
    sticky.surface_energy = 30;
    EXPECT_TRUE(std::holds_alternative<SmoothSand>(make_contact_law({smooth})));
    EXPECT_TRUE(std::holds_alternative<DrySand>(make_contact_law({rough, smooth, smooth, smooth})));
    EXPECT_TRUE(std::holds_alternative<SmoothCementedSand>(make_contact_law({sticky})));
    EXPECT_TRUE(std::holds_alternative<CementedSand>(make_contact_law({smooth, rough, rough, sticky})));
}

} // namespace
} // namespace arenite
