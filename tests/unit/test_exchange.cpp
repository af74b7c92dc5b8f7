// SPDX-License-Identifier: MIT
// The exchange of grains and fluid: volume and momentum close to rounding, nothing is limited silently, grains
// that come and go make no blow, and the bits do not depend on the order of the rows.
#include "fluid/advance_flow.hpp"
#include "fluid/exchange.hpp"
#include "fluid/flow_balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace arenite {
namespace {

constexpr Real diameter = 3e-4, grain_volume = std::numbers::pi_v<Real> / 6 * diameter * diameter * diameter;
constexpr Real fluid_dt = 2e-5;

Region const domain{{0, 0, 0}, {6e-3, 5e-3, 4e-3}};

FluidSettings settings()
{
    FluidSettings fluid;
    fluid.cells = {6, 5, 4};
    fluid.patches.resize(2); // walls elsewhere
    fluid.patches[0].face = Face::x_lower, fluid.patches[0].kind = PatchKind::periodic;
    fluid.patches[1].face = Face::x_upper, fluid.patches[1].kind = PatchKind::periodic;
    fluid.time_step = fluid_dt;
    return fluid;
}

std::vector<Grain> random_grains(int count)
{
    std::mt19937_64 engine(11);
    std::uniform_real_distribution<Real> share(0, 1);
    std::vector<Grain> grains(count);
    for (int g = 0; g < count; ++g) {
        for (int axis = 0; axis < 3; ++axis) {
            Real const place = 0.02 + 0.96 * share(engine); // does not leave within the tests' few steps
            grains[g].position[axis] = domain.lower[axis] + place * (domain.upper[axis] - domain.lower[axis]);
            grains[g].velocity[axis] = 0.05 * (share(engine) - 0.5);
        }
        grains[g].diameter = diameter * (0.7 + 0.3 * share(engine));
        grains[g].id = 100 + g;
    }
    return grains;
}

struct Coupled {
    FluidSettings fluid;
    Particles particles;
    Flow flow;
    FlowBoundary boundary;
    FlowSolver solver;
    Exchange exchange;

    Coupled(FluidSettings const& settings_now, std::vector<Grain> const& grains)
        : fluid(settings_now), particles(make_particles(grains, {2605})),
          flow(make_flow(settings_now, domain, true, {0, 0, -9.81})), boundary(make_boundary(settings_now, flow.grid)),
          solver(make_flow_solver(settings_now, flow)), exchange(make_exchange(flow, particles, settings_now, 1))
    {
    }
    FlowReport step()
    {
        deposit_porosity(flow, exchange, particles);
        deposit_drag(flow, exchange, particles, fluid_dt);
        FlowReport const report = advance_flow(flow, boundary, solver, fluid_dt);
        evaluate_fluid_force(flow, solver, exchange, particles);
        return report;
    }
};

/// Grains fly on in a straight line.
void drift(Particles const& particles_now, Real dt)
{
    Particles const particles = particles_now;
    Kokkos::parallel_for(
        "drift", RangePolicy(0, particles.count), KOKKOS_LAMBDA(int row) {
            for (int axis = 0; axis < 3; ++axis) particles.position(row, axis) += dt * particles.velocity(row, axis);
        });
}

Vec3 total_fluid_force(Particles const& particles)
{
    auto const force = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.fluid_force);
    Vec3 sum;
    for (int row = 0; row < particles.count; ++row) sum += vector_of(force, row);
    return sum;
}

Real largest_change_of_porosity(Flow const& flow)
{
    auto const now = Kokkos::create_mirror_view_and_copy(HostSpace(), flow.porosity);
    auto const before = Kokkos::create_mirror_view_and_copy(HostSpace(), flow.porosity_previous);
    Real most = 0;
    for (int k = 0; k < flow.grid.cells[2]; ++k)
        for (int j = 0; j < flow.grid.cells[1]; ++j)
            for (int i = 0; i < flow.grid.cells[0]; ++i)
                most = std::max(most, std::abs(now(i + 2, j + 2, k + 2) - before(i + 2, j + 2, k + 2)));
    return most;
}

} // namespace

TEST(Exchange, SolidAndFluidFillTheBox)
{
    Coupled run(settings(), random_grains(800));
    deposit_porosity(run.flow, run.exchange, run.particles);
    auto const n = Kokkos::create_mirror_view_and_copy(HostSpace(), run.flow.porosity);
    Real solid = 0, grains = 0;
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 5; ++j)
            for (int i = 0; i < 6; ++i) solid += (1 - n(i + 2, j + 2, k + 2)) * run.flow.grid.cell_volume();
    for (Grain const& g : download(run.particles))
        grains += std::numbers::pi_v<Real> / 6 * g.diameter * g.diameter * g.diameter;
    EXPECT_EQ(run.exchange.report.coupled, 800);
    EXPECT_EQ(run.exchange.report.limited_cells, 0);
    EXPECT_NEAR(solid / grains, 1, 1e-13);
    EXPECT_EQ(largest_change_of_porosity(run.flow), 0); // a first step has no dn/dt
}

/// What is left of the momentum balance of fluid, grains and boundary after each of four steps, over the
/// forces in it; component by component.
std::vector<Vec3> momentum_residuals(ConvectionScheme convection)
{
    FluidSettings fluid = settings();
    fluid.convection = convection;
    Coupled run(fluid, random_grains(800));
    run.step();
    std::vector<Vec3> residuals;
    for (int n = 0; n < 4; ++n) {
        drift(run.particles, fluid_dt);
        Vec3 const before = fluid_totals(run.flow, run.solver.sums).momentum;
        EXPECT_LT(run.step().continuity_error, 1e-8);
        EXPECT_EQ(run.exchange.report.left, 0);
        FluidTotals const after = fluid_totals(run.flow, run.solver.sums);
        Vec3 const grains = total_fluid_force(run.particles), walls = boundary_force(run.flow, run.solver);
        Vec3 const gain = (after.momentum - before) / fluid_dt + grains - after.volume * run.flow.body_force;
        residuals.push_back((gain - walls) / (norm(after.volume * run.flow.body_force) + norm(walls) + norm(grains)));
    }
    return residuals;
}

constexpr Real momentum_rounding = 1e-12; // sums of 1e3 terms

TEST(Exchange, MomentumClosesToRounding)
{
    for (Vec3 const& residual : momentum_residuals(ConvectionScheme::none)) EXPECT_LT(norm(residual), momentum_rounding);
    // The half cells at walls carry no convection of their own, so with it only the periodic axis closes exactly.
    for (Vec3 const& residual : momentum_residuals(ConvectionScheme::limited)) {
        EXPECT_LT(std::abs(residual.x), momentum_rounding);
        EXPECT_LT(norm(residual), 1e-7); // n u^2 over the wall cells against the weight of the water
    }
}

TEST(Exchange, BitsDoNotDependOnTheOrderOfRows)
{
    std::vector<Grain> grains = random_grains(800);
    auto const forces_by_id = [](std::vector<Grain> const& order) {
        Coupled run(settings(), order);
        for (int n = 0; n < 3; ++n) run.step(), drift(run.particles, fluid_dt);
        auto const force = Kokkos::create_mirror_view_and_copy(HostSpace(), run.particles.fluid_force);
        std::vector<std::pair<GrainId, Vec3>> result;
        for (std::size_t row = 0; row < order.size(); ++row)
            result.emplace_back(order[row].id, vector_of(force, static_cast<int>(row)));
        std::sort(result.begin(), result.end(), [](auto const& a, auto const& b) { return a.first < b.first; });
        return result;
    };
    auto const first = forces_by_id(grains);
    std::shuffle(grains.begin(), grains.end(), std::mt19937_64(5));
    auto const second = forces_by_id(grains);
    for (std::size_t g = 0; g < first.size(); ++g) EXPECT_TRUE(first[g].second == second[g].second) << first[g].first;
}

// H7: cells that are emptied in one step, by grains that leave.
TEST(Exchange, GrainsThatLeaveOrEnterMakeNoBlow)
{
    std::vector<Grain> const grains = random_grains(500);
    Coupled run(settings(), grains);
    run.step();
    std::vector<Grain> fewer(grains.begin(), grains.begin() + 300); // 200 removed, the rest at rest in place
    Real const fluid_force_rows = run.particles.fluid_force.extent(0);
    run.particles = make_particles(fewer, {2605});
    deposit_porosity(run.flow, run.exchange, run.particles);
    EXPECT_EQ(run.exchange.report.left, 200);
    EXPECT_EQ(run.exchange.report.entered, 0);
    EXPECT_LT(largest_change_of_porosity(run.flow), 1e-14);
    run.particles = make_particles(grains, {2605});
    FlowReport const report = run.step();
    EXPECT_EQ(run.exchange.report.entered, 200);
    EXPECT_EQ(run.particles.fluid_force.extent(0), fluid_force_rows);
    EXPECT_LT(report.continuity_error, 1e-8);
    EXPECT_LT(report.courant, 0.05);
}

// H5 in numbers.
TEST(Exchange, TooFullCellIsLimitedCountedAndTold)
{
    FluidSettings fluid = settings();
    fluid.smoothing_length = 1e-5;
    Vec3 const middle{3.5e-3, 2.5e-3, 1.5e-3};
    std::vector<Grain> grains(100); // 1.41 cells full in one cell
    for (auto& g : grains) g.position = middle, g.diameter = diameter;
    Coupled run(fluid, grains);
    deposit_porosity(run.flow, run.exchange, run.particles);
    deposit_drag(run.flow, run.exchange, run.particles, fluid_dt);
    Real const cell = run.flow.grid.cell_volume();
    EXPECT_EQ(run.exchange.report.limited_cells, 1);
    EXPECT_NEAR(run.exchange.report.limited_volume / (100 * grain_volume - (1 - fluid.minimum_porosity) * cell), 1, 1e-12);
    EXPECT_NEAR(run.exchange.report.lowest_porosity, 1 - 100 * grain_volume / cell, 1e-12);
    EXPECT_EQ(check_exchange(run.exchange, run.particles).size(), 2u); // support below a diameter, too full
}

TEST(Exchange, NoGrainAndOneGrain)
{
    Coupled nothing(settings(), {});
    for (int n = 0; n < 2; ++n) nothing.step();
    EXPECT_EQ(nothing.exchange.report.coupled, 0);
    EXPECT_EQ(nothing.exchange.report.lowest_porosity, 1);
    EXPECT_TRUE(check_exchange(nothing.exchange, nothing.particles).empty());

    std::vector<Grain> one(1);
    one[0].position = {3e-3, 2e-3, 2e-3}, one[0].diameter = diameter; // at rest in still water
    Coupled run(settings(), one);
    for (int n = 0; n < 2; ++n) run.step();
    Real const buoyancy = run.flow.density * 9.81 * grain_volume;
    EXPECT_NEAR(total_fluid_force(run.particles).z / buoyancy, 1, 1e-6); // by the hydrostatic pressure gradient
}

TEST(Exchange, GrainOutsideTheBoxFeelsNothing)
{
    std::vector<Grain> grains = random_grains(2);
    grains[1].position.z = 1;
    Coupled run(settings(), grains);
    run.step();
    auto const force = Kokkos::create_mirror_view_and_copy(HostSpace(), run.particles.fluid_force);
    EXPECT_EQ(run.exchange.report.coupled, 1);
    EXPECT_TRUE(vector_of(force, 1) == Vec3{});
    EXPECT_FALSE(vector_of(force, 0) == Vec3{});
}

TEST(Exchange, LongFluidStepIsTold)
{
    Coupled run(settings(), random_grains(500));
    run.step();
    Real const stiffness = drag_stiffness(run.exchange, run.particles);
    EXPECT_GT(stiffness, fluid_dt * 18 * 1e-3 / (2605 * diameter * diameter)); // Stokes' relaxation at the least
    EXPECT_TRUE(check_exchange(run.exchange, run.particles).empty());
    deposit_drag(run.flow, run.exchange, run.particles, fluid_dt / stiffness);
    EXPECT_NEAR(drag_stiffness(run.exchange, run.particles), 1, 0.2); // beta changed with the flow
    EXPECT_EQ(check_exchange(run.exchange, run.particles).size(), 1u);
}

} // namespace arenite
