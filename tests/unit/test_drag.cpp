// SPDX-License-Identifier: MIT
// Every drag law at points known from closed forms, and its limit at rest.
#include "fluid/drag.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace arenite {
namespace {

constexpr Real water_density = 998.2, water_viscosity = 1e-3, pi = std::numbers::pi_v<Real>;
constexpr Real printed = 1e-9; // the reference values carry ten digits

FluidSettings water(DragLaw law)
{
    FluidSettings fluid;
    fluid.density = water_density;
    fluid.viscosity = water_viscosity;
    fluid.drag = law;
    fluid.drag_constant = 3e-6;
    return fluid;
}

Real coefficient(FluidSettings const& fluid, DragPoint<Real> const& at, Real factor = 1)
{
    return std::visit([&](auto const& law) { return grain_drag_coefficient(law, at, factor); }, make_drag_law(fluid));
}

/// -dp/dx of a bed at rest [Pa/m]: model A has n dp/dx = -drag per volume.
Real bed_gradient(FluidSettings const& fluid, Real superficial, Real porosity, Real diameter)
{
    Real const beta = coefficient(fluid, {diameter, porosity, superficial / porosity});
    return (1 - porosity) / (pi / 6 * diameter * diameter * diameter) * beta * superficial / porosity / porosity;
}

/// Speed at which the drag carries the weight in the fluid, by bisection.
Real terminal_velocity(FluidSettings const& fluid, Real grain_density, Real diameter)
{
    Real const weight = (grain_density - fluid.density) * 9.81 * pi / 6 * diameter * diameter * diameter;
    Real low = 0, high = 10;
    for (int step = 0; step < 80; ++step) {
        Real const speed = (low + high) / 2;
        (coefficient(fluid, {diameter, 1, speed}) * speed < weight ? low : high) = speed;
    }
    return low;
}

constexpr DragLaw all_laws[] = {DragLaw::constant,          DragLaw::stokes,   DragLaw::schiller_naumann, DragLaw::di_felice,
                                DragLaw::di_felice_literal, DragLaw::gidaspow, DragLaw::beetstra};

} // namespace

TEST(Drag, DiFeliceFixedBedGradients)
{
    struct Point {
        Real porosity, superficial, gradient;
    };
    for (auto const& point :
         {Point{0.37, 1e-4, 2280.079768}, Point{0.41, 1e-5, 128.9001244}, Point{0.41, 1e-4, 1318.668271},
          Point{0.41, 1e-3, 13560.85083}, Point{0.41, 1e-2, 135157.1882}, Point{0.45, 1e-2, 83959.78511}})
        EXPECT_NEAR(bed_gradient(water(DragLaw::di_felice), point.superficial, point.porosity, 0.23e-3) / point.gradient, 1,
                    printed);
}

TEST(Drag, PaperSandByClasses)
{
    std::array<Real, 8> const diameter{0.15e-3, 0.18e-3, 0.20e-3, 0.22e-3, 0.25e-3, 0.275e-3, 0.30e-3, 0.355e-3};
    std::array<Real, 8> const share{.058, .075, .088, .1216, .2264, .1705, .121, .1395};
    Real superficial = 0, literal = 0;
    for (int c = 0; c < 8; ++c) {
        superficial += share[c] * bed_gradient(water(DragLaw::di_felice), 1e-4, 0.41, diameter[c]);
        literal += share[c] * bed_gradient(water(DragLaw::di_felice_literal), 1e-4, 0.41, diameter[c]);
    }
    EXPECT_NEAR(superficial / 1250.561596, 1, printed);
    EXPECT_NEAR(literal / 3089.152426, 1, printed); // 2.47 times too much
}

TEST(Drag, GidaspowIsErgunInABed)
{
    EXPECT_NEAR(bed_gradient(water(DragLaw::gidaspow), 1e-4, 0.41, 0.23e-3) / 1432.8, 1, 2e-6); // six digits
    EXPECT_NEAR(bed_gradient(water(DragLaw::gidaspow), 1e-2, 0.41, 0.23e-3) / 149717, 1, 4e-6);
    FluidSettings gas = water(DragLaw::gidaspow); // the ErgunTestMPI tutorial of CFDEM
    gas.density = 10;
    gas.viscosity = 1.5e-3;
    EXPECT_NEAR(bed_gradient(gas, 0.002, 0.451335, 1e-3) * 0.0156 / 22.99205015, 1, printed);
    EXPECT_NEAR(bed_gradient(gas, 0.02, 0.451335, 1e-3) * 0.0156 / 230.5070114, 1, printed);
}

TEST(Drag, BeetstraIsCarmanKozenyInADenseBedAtRest)
{
    // F = 10 phi/n^2 + n^2 (1 + 1.5 sqrt(phi)); the first term alone is Kozeny-Carman with 180.
    Real const n = 0.41, phi = 0.59, d = 0.23e-3;
    Real const kozeny = 180 * water_viscosity * phi * phi / (n * n * n * d * d) * 1e-12;
    Real const rest = n * n * (1 + 1.5 * std::sqrt(phi)) / (10 * phi / (n * n));
    EXPECT_NEAR(bed_gradient(water(DragLaw::beetstra), 1e-12, n, d) / (kozeny * (1 + rest)), 1,
                1e-7); // Re 2e-10 is left
    // Re = 100: the formula as published, not multiplied out
    auto const published = [](Real solid, Real re) {
        Real const e = 1 - solid;
        return 10 * solid / (e * e) + e * e * (1 + 1.5 * std::sqrt(solid)) +
               0.413 * re / (24 * e * e) * (1 / e + 3 * e * solid + 8.4 * std::pow(re, -0.343)) /
                   (1 + std::pow(10., 3 * solid) * std::pow(re, -(1 + 4 * solid) / 2));
    };
    for (Real const solid : {0.1, 0.5}) {
        Real const slip = 100 * water_viscosity / (water_density * (1 - solid) * d);
        Real const beta = coefficient(water(DragLaw::beetstra), {d, 1 - solid, slip});
        EXPECT_NEAR(beta / (3 * pi * water_viscosity * d * (1 - solid)) / published(solid, 100), 1, 1e-13);
    }
}

TEST(Drag, TerminalVelocitiesInWater)
{
    struct Row {
        Real diameter, di_felice, schiller_naumann, stokes;
    };
    for (auto const& row :
         {Row{0.15e-3, 0.014423638, 0.015539606, 0.019703385}, Row{0.23e-3, 0.027330186, 0.029683397, 0.046324847},
          Row{0.355e-3, 0.048289111, 0.052216743, 0.11036085}, Row{0.46e-3, 0.065331051, 0.070371406, 0.18529939}}) {
        constexpr Real eight_digits = 5e-8;
        EXPECT_NEAR(terminal_velocity(water(DragLaw::di_felice), 2605, row.diameter) / row.di_felice, 1, eight_digits);
        EXPECT_NEAR(terminal_velocity(water(DragLaw::schiller_naumann), 2605, row.diameter) / row.schiller_naumann, 1,
                    eight_digits);
        EXPECT_NEAR(terminal_velocity(water(DragLaw::stokes), 2605, row.diameter) / row.stokes, 1, eight_digits);
        // Wen & Yu without neighbours is Schiller & Naumann
        EXPECT_NEAR(terminal_velocity(water(DragLaw::gidaspow), 2605, row.diameter) / row.schiller_naumann, 1, eight_digits);
    }
}

TEST(Drag, FiniteAndContinuousAtRest)
{
    for (DragLaw const law : all_laws)
        for (Real const porosity : {0.2, 0.41, 0.79, 0.81, 1.0}) {
            Real const rest = coefficient(water(law), {0.23e-3, porosity, 0});
            Real const near = coefficient(water(law), {0.23e-3, porosity, 1e-14});
            EXPECT_TRUE(std::isfinite(rest) && rest > 0);
            EXPECT_NEAR(near / rest, 1, 1e-5) << static_cast<int>(law); // Dallavalle goes as sqrt(Re) = 5e-5 x 0.26
        }
    Real const creeping = pi / 8 * 4.8 * 4.8 * water_viscosity * 0.23e-3; // Dallavalle: 23.04/24 of Stokes' drag
    EXPECT_NEAR(coefficient(water(DragLaw::di_felice), {0.23e-3, 1, 0}) / creeping, 1, 1e-14);
    EXPECT_EQ(coefficient(water(DragLaw::none), {0.23e-3, 0.41, 1}), 0);
}

/// Grains at rest and fast ones, dense and dilute, side by side in one vector.
TEST(Drag, EveryLaneIsOneGrain)
{
    std::vector<DragPoint<Real>> points;
    for (Real const slip : {0., 1e-12, 1e-6, 1e-3, 0.1, 30.})
        for (Real const porosity : {0.41, 0.9, 0.2, 1.0, 0.79})
            for (Real const diameter : {0.15e-3, 0.355e-3}) points.push_back({diameter, porosity, slip});
    for (DragLaw const law : all_laws)
        for (std::size_t first = 0; first + lane_count <= points.size(); ++first) {
            DragPoint<Real> const* const of = &points[first];
            Real diameter[lane_count], porosity[lane_count], slip_speed[lane_count];
            for (int n = 0; n < lane_count; ++n) {
                diameter[n] = of[n].diameter;
                porosity[n] = of[n].porosity;
                slip_speed[n] = of[n].slip_speed;
            }
            DragPoint<Lanes> const at{load_lanes(diameter), load_lanes(porosity), load_lanes(slip_speed)};
            Lanes const beta =
                std::visit([&](auto const& l) { return grain_drag_coefficient(l, at, Real(2)); }, make_drag_law(water(law)));
            for (int n = 0; n < lane_count; ++n)
                EXPECT_NEAR(lane(beta, n) / coefficient(water(law), of[n], 2), 1, 1e-14) << static_cast<int>(law);
        }
}

TEST(Drag, GrainOfFactorKIsItsOriginalParticles)
{
    for (DragLaw const law : all_laws) {
        Real const one = coefficient(water(law), {0.23e-3, 0.41, 1e-3});
        EXPECT_NEAR(coefficient(water(law), {0.46e-3, 0.41, 1e-3}, 2) / (8 * one), 1, 1e-14);
    }
    EXPECT_EQ(coefficient(water(DragLaw::constant), {0.23e-3, 0.41, 1}), 3e-6);
}

} // namespace arenite
