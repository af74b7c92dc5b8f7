// SPDX-License-Identifier: MIT
// Held grains in a flow: the pressure gradient that the drag law's closed form gives at the bed's porosity, the
// same for coarse grains, the same for fluid steps of any length, and what is left of the momentum balance.
#include "apps/verify/beds.hpp"
#include "apps/verify/coarse_checks.hpp"
#include "apps/verify/coupling_checks.hpp"
#include "core/random.hpp"
#include "fluid/flow_balance.hpp"

#include <fmt/format.h>

namespace arenite {
namespace {

/// The steady bed, by steps far beyond the fluid's drag time.
Bed flow_through(BedSettings const& settings)
{
    Bed bed = make_bed(settings);
    for (int n = 0; n < 6; ++n) bed.run.exchange_step(1);
    return bed;
}

BedSettings sand_bed(Real porosity, Real superficial)
{
    BedSettings settings;
    settings.porosity = porosity;
    settings.superficial = superficial;
    return settings;
}

} // namespace

std::vector<VerifyCase> check_fixed_bed()
{
    struct Case {
        Real porosity, superficial, gradient;
    };
    std::vector<VerifyCase> rows;
    for (Case const& c : {Case{0.37, 1e-5, 222.98332}, Case{0.37, 1e-4, 2280.079768}, Case{0.37, 1e-3, 23300.7785},
                          Case{0.37, 1e-2, 225796.0446}, Case{0.41, 1e-5, 128.9001244}, Case{0.41, 1e-4, 1318.668271},
                          Case{0.41, 1e-3, 13560.85083}, Case{0.41, 1e-2, 135157.1882}, Case{0.45, 1e-5, 77.580814},
                          Case{0.45, 1e-4, 794.0028319}, Case{0.45, 1e-3, 8212.019907}, Case{0.45, 1e-2, 83959.78511}}) {
        Bed const bed = flow_through(sand_bed(c.porosity, c.superficial));
        rows.push_back(compare({fmt::format("C4 lattice of 0.23 mm, n {}, U {:g} m/s", c.porosity, c.superficial),
                                "-dp/dz [Pa/m]", "Di Felice 1994 at the bed's n"},
                               pressure_gradient(bed), c.gradient, 1e-3));
        if (c.superficial == 1e-4) // what the grains feel is the whole gradient
            rows.push_back(compare({fmt::format("C4 lattice of 0.23 mm, n {}, U {:g} m/s", c.porosity, c.superficial),
                                    "force on the grains / volume [Pa/m]", "momentum balance"},
                                   total_fluid_force(bed.run.grains.particles).z / (bed.area * bed.height), c.gradient,
                                   1e-2));
    }
    BedSettings gidaspow = sand_bed(0.41, 1e-4);
    gidaspow.drag = DragLaw::gidaspow;
    rows.push_back(compare({"C4 lattice of 0.23 mm, n 0.41, U 1e-4 m/s", "-dp/dz [Pa/m]", "Ergun 1952 (Gidaspow)"},
                           pressure_gradient(flow_through(gidaspow)), 1432.80, 1e-3));
    return rows;
}

namespace {

/// CFDEM's ErgunTestMPI.
BedSettings ergun_bed(Real superficial)
{
    BedSettings settings = sand_bed(0.451335, superficial);
    settings.diameter = 1e-3;
    settings.drag = DragLaw::gidaspow;
    settings.density = 10;
    settings.viscosity = 1.5e-3;
    settings.grain_density = 2000;
    return settings;
}

/// Superficial velocity at which the fluid carries the grains, by the secant rule.
Real fluidisation_velocity(BedSettings settings, Real guess)
{
    settings.gravity = true;
    auto const excess = [&](Real superficial) {
        settings.superficial = superficial;
        return carried_weight(flow_through(settings)) - 1;
    };
    Real low = 0.9 * guess, high = 1.1 * guess, at_low = excess(low), at_high = excess(high);
    for (int n = 0; n < 3; ++n) {
        Real const next = high - at_high * (high - low) / (at_high - at_low);
        low = high;
        at_low = at_high;
        high = next;
        at_high = excess(next);
    }
    return high;
}

} // namespace

std::vector<VerifyCase> check_ergun_bed()
{
    std::vector<VerifyCase> rows;
    std::string const name = "C4b lattice of 1 mm, rho 10, nu 1.5e-4, L 15.6 mm";
    for (auto const& [superficial, drop] : {std::pair{0.002, 22.99205015}, {0.01, 115.0905863}, {0.02, 230.5070114}})
        rows.push_back(compare({name, fmt::format("pressure drop at U {} m/s [Pa]", superficial), "Ergun 1952"},
                               pressure_gradient(flow_through(ergun_bed(superficial))) * 0.0156, drop, 2e-2));
    rows.push_back(compare({name, "U_mf, where the fluid carries the grains [m/s]", "Ergun 1952, viscous part"},
                           fluidisation_velocity(ergun_bed(0), 0.0145), 0.01453882633, 2e-2));
    return rows;
}

namespace {

/// Superficial velocity [m/s] at 1250.6 Pa/m through a periodic random pack of the paper's sand at n 0.41.
Real paper_velocity(Real factor)
{
    BedSettings settings = sand_bed(0.41, 0);
    settings.push = 1250.6;
    settings.paper_sizes = true;
    settings.relaxed = true;
    settings.factor = factor;
    settings.cells = {4, 4, 10}; // 1.3 mm: 216, 27 and 3.4 grains to a cell
    return superficial_velocity(flow_through(settings));
}

} // namespace

std::vector<VerifyCase> check_paper_bed()
{
    std::vector<VerifyCase> rows;
    std::string const quantity = "U at 1250.6 Pa/m [m/s]", closed = "Di Felice 1994 over the sieve curve";
    Real const original = paper_velocity(1);
    rows.push_back(compare({"C4c random pack of the paper's sand, n 0.41", quantity, closed}, original, 1e-4, 2e-2));
    for (Real const k : {2.0, 4.0})
        rows.push_back(
            compare({fmt::format("C4c, G4 random pack of the paper's sand, k = {}", k), quantity, "the same at k = 1"},
                    paper_velocity(k), original, 1e-2));
    return rows;
}

std::vector<VerifyCase> check_coarse_bed()
{
    std::vector<VerifyCase> rows;
    Real const original = pressure_gradient(flow_through(sand_bed(0.41, 1e-3)));
    for (Real const k : {2.0, 3.0}) {
        BedSettings coarse = sand_bed(0.41, 1e-3);
        coarse.factor = k;
        rows.push_back(
            compare({fmt::format("G4 lattice of one size, k = {}", k), "-dp/dz at 1e-3 m/s [Pa/m]", "the same at k = 1"},
                    pressure_gradient(flow_through(coarse)), original, 1e-2));
    }
    return rows;
}

std::vector<VerifyCase> check_fluid_steps()
{
    BedSettings settings = sand_bed(0.41, 1e-3);
    settings.grains_per_edge = 3;
    auto const gradient = [&](Real dt, int steps) {
        Bed bed = make_bed(settings);
        for (int n = 0; n < steps; ++n) bed.run.exchange_step(dt);
        return pressure_gradient(bed);
    };
    Real const reference = gradient(1, 10);
    std::vector<VerifyCase> rows;
    // The fluid's own drag time rho n / B is 1.8e-4 s.
    for (auto const& [dt, steps] : {std::pair{1e-5, 300}, {1e-4, 40}, {1e-3, 30}, {1e-2, 20}})
        rows.push_back(compare({fmt::format("C13 lattice, n 0.41, fluid step {:g} s", dt), "-dp/dz at 1e-3 m/s [Pa/m]",
                                "the same by steps of 1 s"},
                               gradient(dt, steps), reference, 1e-6));
    return rows;
}

std::vector<VerifyCase> check_fluidisation()
{
    std::vector<VerifyCase> rows;
    BedSettings sizes = sand_bed(0.41, 0);
    sizes.paper_sizes = true;
    sizes.cells = {4, 4, 10};
    std::string const quantity = "U_mf, where the fluid carries the grains [m/s]";
    rows.push_back(compare({"C5 lattice of 0.23 mm, n 0.41", quantity, "Di Felice 1994"},
                           fluidisation_velocity(sand_bed(0.41, 0), 6.9e-4), 6.875026e-4, 3e-2));
    rows.push_back(compare({"C5 lattice with the paper's sizes, n 0.41", quantity, "Di Felice 1994 over the sieve curve"},
                           fluidisation_velocity(sizes, 7.2e-4), 7.248e-4, 3e-2));
    return rows;
}

namespace {

CoupledCase make_random_suspension(ConvectionScheme convection)
{
    CoupledSettings settings;
    settings.fluid = box_settings({6, 5, 4}, {6e-3, 5e-3, 4e-3});
    add_periodic_axis(settings.fluid, 0);
    settings.fluid.gravity = true;
    settings.fluid.convection = convection;
    for (int g = 0; g < 800; ++g) {
        auto const draw = [&](int n) { return random_uniform(11, g, n); };
        Vec3 const size = settings.fluid.box->upper;
        auto const place = [&](int axis) { return (0.02 + 0.96 * draw(axis)) * size[axis]; };
        settings.grains.grains.push_back(make_grain(g, {place(0), place(1), place(2)}, 3e-4 * (0.7 + 0.3 * draw(3)),
                                                    0.05 * Vec3{draw(4) - 0.5, draw(5) - 0.5, draw(6) - 0.5}));
        settings.grains.grains.back().motion = Motion::prescribed; // flies on in a straight line
    }
    settings.grains.materials = {sand()};
    settings.grains.box.upper = settings.fluid.box->upper;
    settings.grains.box.periodic[0] = true;
    settings.grains.skin = 1e-4;
    settings.grains.dt = 2e-5;
    return make_coupled_case(settings);
}

/// Gain of the fluid + force on the grains - weight - force of the walls, over the forces in it; the largest of
/// four steps, along the periodic axis and along all.
struct Residual {
    Real periodic = 0, all = 0;
};

Residual momentum_residual(ConvectionScheme convection)
{
    CoupledCase run = make_random_suspension(convection);
    Real const dt = run.grains.settings.dt;
    run.step(dt);
    Residual worst;
    for (int n = 0; n < 4; ++n) {
        Vec3 const before = fluid_totals(run.fluid.flow, run.fluid.solver.sums).momentum;
        run.exchange_step(dt);
        FluidTotals const after = fluid_totals(run.fluid.flow, run.fluid.solver.sums);
        Vec3 const grains = total_fluid_force(run.grains.particles),
                   walls = boundary_force(run.fluid.flow, run.fluid.solver),
                   weight = after.volume * run.fluid.flow.body_force;
        Vec3 const left = (after.momentum - before) / dt + grains - weight - walls;
        Real const scale = norm(weight) + norm(walls) + norm(grains);
        worst.periodic = std::fmax(worst.periodic, std::fabs(left.x) / scale);
        worst.all = std::fmax(worst.all, norm(left) / scale);
        advance(run.grains, 1);
    }
    return worst;
}

} // namespace

std::vector<VerifyCase> check_momentum_balance()
{
    std::string const name = "C3 800 grains fly through water, 4 steps",
                      quantity = "momentum of fluid + grains + walls, relative", source = "Newton's third law";
    Residual const still = momentum_residual(ConvectionScheme::none), carried = momentum_residual(ConvectionScheme::limited);
    return {compare_error({name, quantity, source}, still.all, 1e-12),
            compare_error({name + ", with convection", quantity + ", periodic axis", source}, carried.periodic, 1e-12),
            // The half cells at walls carry no convection of their own: n u^2 there against the weight of the water.
            compare_error({name + ", with convection", quantity, source}, carried.all, 1e-7)};
}

} // namespace arenite
