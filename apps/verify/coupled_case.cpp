// SPDX-License-Identifier: MIT
#include "apps/verify/coupled_case.hpp"

namespace arenite {

FlowReport CoupledCase::exchange_step(Real dt)
{
    deposit_porosity(fluid.flow, exchange, grains.particles);
    deposit_drag(fluid.flow, exchange, grains.particles, dt);
    FlowReport const report = fluid.step(dt);
    evaluate_fluid_force(fluid.flow, fluid.solver, exchange, grains.particles);
    converged = converged && report.converged();
    return report;
}

void CoupledCase::step(Real dt)
{
    exchange_step(dt);
    advance(grains, static_cast<int>(std::lround(dt / grains.settings.dt)));
}

CoupledCase make_coupled_case(CoupledSettings const& settings)
{
    SystemSettings system = settings.grains;
    system.gravity = settings.gravity;
    CoupledCase c{make_system(system), {}, {}};
    c.fluid.flow = make_flow(settings.fluid, settings.fluid.box.value(), true, settings.gravity);
    c.fluid.boundary = make_boundary(settings.fluid, c.fluid.flow.grid);
    c.fluid.solver = make_flow_solver(settings.fluid, c.fluid.flow);
    c.exchange = make_exchange(c.fluid.flow, c.grains.particles, settings.fluid, settings.coarse_grain_factor);
    return c;
}

std::array<Real, 4> fluid_at_grain(Exchange const& exchange)
{
    GrainWeights const weights = exchange.weights;
    TableView const cell = exchange.cell_value;
    View1<Real> const value("fluid_at_grain", 4);
    Kokkos::parallel_for(
        "fluid_at_grain", RangePolicy(0, 1), KOKKOS_LAMBDA(int entry) {
            Real fluid[4];
            interpolate_at(weights, entry, cell, fluid);
            for (int q = 0; q < 4; ++q) value(q) = fluid[q];
        });
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), value);
    return {host(0), host(1), host(2), host(3)};
}

Real terminal_slip(FluidSettings const& fluid, Real diameter, Real grain_density, Real porosity)
{
    constexpr Real gravity = 9.81;
    Real const weight = porosity * (grain_density - fluid.density) * gravity * sphere_volume_of(diameter);
    AnyDragLaw const any_law = make_drag_law(fluid);
    Real low = 0, high = 1;
    for (int n = 0; n < 60; ++n) {
        Real const slip = (low + high) / 2;
        Real const beta =
            std::visit([&](auto const& law) { return law(DragPoint<Real>{diameter, porosity, slip}); }, any_law);
        (beta * slip < weight ? low : high) = slip;
    }
    return low;
}

Vec3 total_fluid_force(Particles const& particles)
{
    auto const force = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.fluid_force);
    Vec3 sum;
    for (int row = 0; row < particles.count; ++row) sum += vector_of(force, row);
    return sum;
}

DistributionSettings paper_sand()
{
    DistributionSettings sand;
    sand.diameters = {0.15e-3, 0.18e-3, 0.20e-3, 0.22e-3, 0.25e-3, 0.275e-3, 0.30e-3, 0.355e-3};
    sand.fractions = {0.058, 0.075, 0.088, 0.1216, 0.2264, 0.1705, 0.121, 0.1395};
    return sand;
}

} // namespace arenite
