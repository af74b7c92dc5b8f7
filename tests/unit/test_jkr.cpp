// SPDX-License-Identifier: MIT
// The JKR law by points: the universal curve, dimensional values, hard inputs, and the life of a contact.
#include "apps/verify/jkr_reference.hpp"
#include "kernels/contact/contact_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace arenite {
namespace {

PairConstants pair_of(NormalLaw law, Real surface_energy = 30)
{
    MaterialSettings material = sand();
    material.surface_energy = surface_energy;
    return make_pair(material, material, contact_settings(law));
}

ContactScale<> scale_of(Real a, Real b) { return contact_scale(sand(), a / 2, b / 2); }

struct CurvePoint {
    Real x, radius, force, stiffness; // overlap/|delta_C|, a/a_C, F/F_C, slope |delta_C|/F_C
};

// Computed with 30 digits; printed with 10 to 12.
constexpr CurvePoint curve[] = {
    {-2.0, 0.616919430786, -0.734315985573, -1.051401143},
    {-1.5, 0.856874134233, -0.957228354558, -0.1926839},
    {-1.0, 1.0, -1.0, 0},
    {-0.5, 1.11376190543, -0.969232131468, 0.1160007003},
    {0, 1.21141372855, -0.888888888889, 0.2019022881},
    {1, 1.37782902733, -0.618929636855, 0.3312158707},
    {2.5, 1.58489853953, -0.00943282527148, 0.4745678746},
    {5, 1.86786862617, 1.41123712955, 0.6534081703},
    {20, 2.9957345309, 16.5148473066, 1.292048741},
    {100, 6.05087910666, 191.773119567, 2.886825874},
};

TEST(Jkr, FollowsTheUniversalCurve)
{
    PairConstants const pair = pair_of(NormalLaw::jkr);
    ContactScale<> const scale = scale_of(0.23e-3, 0.23e-3);
    JkrPoints const points = jkr_points_of(pair, scale.effective_radius);
    constexpr Real printed = 2e-10, step = 1e-5;
    for (CurvePoint const& point : curve) {
        auto const at = [&](Real x) { return jkr_response(-x * points.overlap_C, scale, pair); };
        EXPECT_NEAR(at(point.x).contact_radius / points.radius_C, point.radius, printed * point.radius) << point.x;
        EXPECT_NEAR(at(point.x).force / points.pull_off_force, point.force, printed * std::fmax(1, std::fabs(point.force)))
            << point.x;
        Real const slope = (at(point.x + step).force - at(point.x - step).force) / (2 * step * points.pull_off_force);
        // Rounding over 2 step, and the third derivative (largest near S).
        EXPECT_NEAR(slope, point.stiffness, 1e-8 * std::fmax(1, std::fabs(point.force))) << point.x;
    }
}

struct SandPoint {
    Real d1, d2, pull_off, overlap_C, overlap_B, overlap_S, radius_C, stiffness_B, surface_energy;
};

constexpr SandPoint sand_points[] = {
    {0.15e-3, 0.15e-3, 0.01060287521, -8.026986386e-8, 2.022673823e-7, -1.669680453e-7, 3.005055687e-6, 62904.11287, 30},
    {0.355e-3, 0.355e-3, 0.02509347132, -1.069707131e-7, 2.695493064e-7, -2.225080499e-7, 5.336754854e-6, 111713.0145, 30},
    {0.15e-3, 0.355e-3, 0.01490701267, -8.992384119e-8, 2.265938808e-7, -1.870491274e-7, 3.771352888e-6, 78944.82912, 30},
    {0.23e-3, 0.23e-3, 0.01625774198, -9.256171344e-8, 2.332409024e-7, -1.925361228e-7, 3.995859804e-6, 83644.37876, 30},
    {0.46e-3, 0.46e-3, 0.06503096793, -1.851234269e-7, 4.664818047e-7, -3.850722455e-7, 7.991719607e-6, 167288.7575, 60},
};

TEST(Jkr, HasTheSandsDimensionalPoints)
{
    constexpr Real printed = 1e-9;
    for (SandPoint const& point : sand_points) {
        PairConstants const pair = pair_of(NormalLaw::jkr, point.surface_energy);
        ContactScale<> const scale = scale_of(point.d1, point.d2);
        Real const length = pair.length_factor / scale.inverse_cube_root;
        EXPECT_NEAR(length * jkr_points::overlap_C / point.overlap_C, 1, printed);
        EXPECT_NEAR(length * jkr_points::overlap_B / point.overlap_B, 1, printed);
        EXPECT_NEAR(length * jkr_points::overlap_S / point.overlap_S, 1, printed);
        NormalResponse<> const at_C = jkr_response(point.overlap_C, scale, pair);
        EXPECT_NEAR(at_C.pull_off_force / point.pull_off, 1, printed);
        EXPECT_NEAR(at_C.force / point.pull_off, -1, printed);
        EXPECT_NEAR(at_C.contact_radius / point.radius_C, 1, printed);
        Real const h = 1e-4 * length;
        Real const slope =
            (jkr_response(point.overlap_B + h, scale, pair).force - jkr_response(point.overlap_B - h, scale, pair).force) /
            (2 * h);
        EXPECT_NEAR(slope / point.stiffness_B, 1, 1e-8);
    }
}

TEST(Jkr, IsFiniteForEveryOverlap)
{
    PairConstants const pair = pair_of(NormalLaw::jkr);
    ContactScale<> const scale = scale_of(0.23e-3, 0.23e-3);
    Real const length = pair.length_factor / scale.inverse_cube_root;
    Real const at_S = jkr_root(jkr_points::overlap_S);
    EXPECT_NEAR(at_S, std::cbrt(0.5), 1e-15);
    for (Real const below : {-1e6, -2.0, std::nextafter(jkr_points::overlap_S, -2.0)}) EXPECT_EQ(jkr_root(below), at_S);
    for (Real const scaled : {std::nextafter(jkr_points::overlap_S, 0.0), 1e-300, -1e-300, 0.0, 1e6, 1e12}) {
        NormalResponse<> const response = jkr_response(scaled * length, scale, pair);
        EXPECT_TRUE(std::isfinite(response.force)) << scaled;
        EXPECT_GT(response.contact_radius, 0) << scaled;
    }
    // A million |delta_C|: 37 times beyond what the start value was fitted for.
    Real const far = -1e6 * jkr_points::overlap_C;
    EXPECT_NEAR(jkr_root(far) / static_cast<Real>(reference_root(far)), 1, 1e-9);
}

TEST(Jkr, ContactRadiusGrowsWithTheOverlap)
{
    Real previous = 0;
    for (int n = 0; n <= 100000; ++n) {
        Real const root = jkr_root(jkr_points::overlap_S + n * 1e-3);
        ASSERT_GT(root, previous) << n;
        previous = root;
    }
}

TEST(Jkr, BecomesHertzWithoutAdhesion)
{
    ContactScale<> const scale = scale_of(0.23e-3, 0.23e-3);
    PairConstants const pair = pair_of(NormalLaw::jkr, 1e-9);
    constexpr Real overlap = 1e-7;
    NormalResponse<> const hertz = hertz_response(overlap, scale.effective_radius, pair.effective_youngs_modulus);
    // sqrt(16 pi gamma E* a^3) / F, the leading term.
    constexpr Real small = 1e-4;
    EXPECT_NEAR(jkr_response(overlap, scale, pair).force / hertz.force, 1, small);
    EXPECT_NEAR(jkr_response(overlap, scale, pair).contact_radius / hertz.contact_radius, 1, small);
}

TEST(Jkr, ForceFollowsFromTheContactRadius)
{
    ContactScale<> const scale = scale_of(0.23e-3, 0.4e-3);
    PairConstants const pair = pair_of(NormalLaw::jkr);
    Real const length = 1 / jkr_inverse_length(scale, pair), radius = scale.effective_radius;
    for (Real scaled = jkr_points::overlap_S; scaled < 1000; scaled += 0.37) {
        NormalResponse<> const bond = jkr_response(scaled * length, scale, pair);
        Real const size = std::fabs(bond.force) + bond.pull_off_force;
        EXPECT_NEAR(JkrNormal::force_at_radius(bond.contact_radius, radius, pair, true), bond.force, 1e-14 * size) << scaled;
        if (scaled < 0) continue;
        NormalResponse<> const hertz = hertz_response(scaled * length, radius, pair.effective_youngs_modulus);
        EXPECT_NEAR(JkrNormal::force_at_radius(hertz.contact_radius, radius, pair, false), hertz.force, 1e-15 * hertz.force)
            << scaled;
    }
}

/// The law at an overlap for a contact with that memory.
std::pair<Real, ContactState<>> apply(NormalLaw law, Real overlap, bool adhering)
{
    ContactState<> state;
    state.adhering = adhering;
    Vec3 const force = CementedSand{}({{0, 0, 1}, overlap, {}, scale_of(0.23e-3, 0.23e-3)}, pair_of(law), state, 1e-8);
    return {force.z, state};
}

TEST(Jkr, ContactsFormAtTheTouchAndBreakAtTheirOverlapToRounding)
{
    PairConstants const pair = pair_of(NormalLaw::jkr);
    Real const length = pair.length_factor / scale_of(0.23e-3, 0.23e-3).inverse_cube_root;
    Real const C = jkr_points::overlap_C * length, S = jkr_points::overlap_S * length;
    Real const pull_off = 1.625774198e-2, above = 1 - 1e-15, below = 1 + 1e-15;
    struct Case {
        NormalLaw law;
        Real overlap;
        bool adhered, adheres;
        Real force;
    };
    Case const cases[] = {
        {NormalLaw::jkr, 0, false, true, -8 * pull_off / 9}, // a touch makes a contact
        {NormalLaw::jkr, -1e-20, false, false, 0},
        {NormalLaw::jkr, S * above, true, true, -5 * pull_off / 9},
        {NormalLaw::jkr, S * below, true, false, 0},
        {NormalLaw::modified_jkr, 0, false, false, 0},
        {NormalLaw::modified_jkr, 0, true, true, -8 * pull_off / 9},
        {NormalLaw::modified_jkr, C * above, true, true, -pull_off},
        {NormalLaw::modified_jkr, C * below, true, false, 0},
    };
    for (Case const& c : cases) {
        auto const [force, state] = apply(c.law, c.overlap, c.adhered);
        EXPECT_EQ(state.adhering, c.adheres) << c.overlap;
        EXPECT_EQ(state.touching, c.adheres) << c.overlap;
        EXPECT_NEAR(force, c.force, 1e-7 * pull_off) << c.overlap;
    }
}

TEST(Jkr, APairWithoutSurfaceEnergyHoldsNoBond)
{
    // Grains of different surface energies do not adhere; a stage that bonds what touches marks them like all others.
    ContactScale<> const scale = scale_of(0.23e-3, 0.23e-3);
    PairConstants const pair = pair_of(NormalLaw::modified_jkr, 0);
    for (Real const overlap : {0.0, 1e-8, 1e-6}) {
        ContactState<> state;
        state.adhering = true;
        Vec3 const force = CementedSand{}({{0, 0, 1}, overlap, {}, scale}, pair, state, 1e-8);
        EXPECT_FALSE(state.adhering) << overlap;
        EXPECT_EQ(force.z, hertz_response(overlap, scale.effective_radius, pair.effective_youngs_modulus).force) << overlap;
    }
}

TEST(Jkr, BreakPointAIsTheTouch)
{
    ContactSettings settings = contact_settings(NormalLaw::modified_jkr);
    settings.break_point = BreakPoint::A;
    PairConstants const pair = make_pair(sand(), sand(), settings);
    ContactState<> state;
    state.adhering = 1;
    ContactScale<> const scale = scale_of(0.23e-3, 0.23e-3);
    EXPECT_LT(CementedSand{}({{0, 0, 1}, 0, {}, scale}, pair, state, 1e-8).z, 0);
    EXPECT_EQ(CementedSand{}({{0, 0, 1}, -1e-20, {}, scale}, pair, state, 1e-8).z, 0);
    EXPECT_FALSE(state.adhering);
}

} // namespace
} // namespace arenite
