// SPDX-License-Identifier: MIT
// Lattices of coarse-grained sand: the stress-strain curve is the same for every k, the stress is the same by the
// virial, by the force on a plate and by the stored energy, and the largest stable step grows with k.
#include "apps/verify/coarse_checks.hpp"
#include "apps/verify/jkr_reference.hpp"
#include "apps/verify/lattice.hpp"
#include "core/critical_time_step.hpp"
#include "core/random.hpp"
#include "kernels/diagnostics.hpp"
#include "kernels/stress.hpp"

#include <fmt/format.h>

namespace arenite {
namespace {

/// Distance [m] between neighbours under a pressure: p = F/D^2 (SC), 2 sqrt(2) F/D^2 (FCC), by bisection on the long
/// double curve.
long double spacing_under(Real pressure, Lattice const& lattice)
{
    Real const d = lattice.diameter();
    MaterialSettings material = sand();
    material.surface_energy *= lattice.factor;
    JkrPoints const points = jkr_points_of(make_pair(material, material, contact_settings(NormalLaw::jkr)), d / 4);
    long double low = 0, high = 0.1L * d; // overlap
    for (int n = 0; n < 120; ++n) {
        long double const middle = (low + high) / 2, distance = d - middle;
        long double const force = reference_force(middle / points.length) * points.pull_off_force;
        long double const found = (lattice.face_centred ? 2 * sqrtl(2.0L) : 1) * force / (distance * distance);
        (found < pressure ? low : high) = middle;
    }
    return d - (low + high) / 2;
}

Vec3 virial_stress(GrainSystem const& system)
{
    SumWorkspace sums;
    return mean_stress(system.particles, system.settings.box, system.contacts, sums);
}

Real stored_energy(GrainSystem const& system)
{
    SumWorkspace sums;
    return std::visit(
        [&](auto const& law) {
            return report_contacts(law, system.particles, system.settings.box, system.contacts, sums).elastic;
        },
        system.law);
}

/// -dE/dV [Pa] by a stretch along z (SC: one of three families of contacts) or along all axes (FCC).
Real energy_stress(Lattice const& lattice, Real spacing)
{
    auto const energy = [&](Real strain) {
        Real const along = 1 + strain;
        return stored_energy(make_system(lattice.face_centred ? make_lattice(lattice, spacing * along)
                                                              : make_lattice(lattice, spacing, along)));
    };
    constexpr Real h = 2e-5;
    Real const slope = (8 * (energy(h) - energy(-h)) - energy(2 * h) + energy(-2 * h)) / (12 * h);
    Real const edge = lattice.cells * lattice.edge(spacing), volume = edge * edge * edge;
    return -slope / (lattice.face_centred ? 3 * volume : volume);
}

/// Mean normal stress on a plane through the grains of the lowest layer: the pull of all contacts that cross it, by
/// holding that layer as a plate and cutting what lies below it.
Real plate_stress(Lattice const& lattice, Real spacing)
{
    SystemSettings settings = make_lattice(lattice, spacing);
    settings.box.periodic[2] = false; // what would reach through the lower face has no partner any more
    GrainSystem const system = make_system(settings);
    Real force = 0;
    for (Grain const& grain : grains_by_id(system))
        if (grain.position.z < Real(0.3) * lattice.edge(spacing)) force -= force_on(system, grain.id).z;
    Real const edge = lattice.cells * lattice.edge(spacing);
    return force / (edge * edge);
}

struct StressPoint {
    Real pressure, overlap, modulus; // Pa, m at k = 1, Pa
};

void add_rows(std::vector<VerifyCase>& rows, Lattice const& lattice, StressPoint const& point)
{
    Real const spacing = static_cast<Real>(spacing_under(point.pressure, lattice));
    GrainSystem const system = make_system(make_lattice(lattice, spacing));
    Vec3 const stress = virial_stress(system);
    std::string const name = fmt::format("G2, D14 {}, k = {}, {:g} MPa",
                                         lattice.face_centred ? "FCC isotropic" : "SC oedometer", lattice.factor,
                                         point.pressure * 1e-6),
                      closed = "closed form: JKR at F/D^2, long double";
    rows.push_back(compare({name, "overlap / k [m]", "lattice_stress.csv, 8 digits"},
                           (lattice.diameter() - spacing) / lattice.factor, point.overlap, 2e-8));
    rows.push_back(compare({name, "virial stress zz [Pa]", closed}, stress.z, point.pressure, 1e-8));
    rows.push_back(compare({name, "virial stress xx [Pa]", closed}, stress.x, point.pressure, 1e-8));
    rows.push_back(compare({name, "-dE/dV [Pa]", closed}, energy_stress(lattice, spacing), point.pressure, 1e-8));
    rows.push_back(
        compare({name, "force on a plate / area [Pa]", closed}, plate_stress(lattice, spacing), point.pressure, 1e-8));
    if (lattice.face_centred) return;
    constexpr Real h = 1e-5; // strain
    auto const at = [&](Real strain) { return virial_stress(make_system(make_lattice(lattice, spacing, 1 + strain))).z; };
    rows.push_back(compare({name, "modulus k/D [Pa]", "lattice_stress.csv, 6 digits"}, (at(-h) - at(h)) / (2 * h),
                           point.modulus, 1e-5));
}

} // namespace

std::vector<VerifyCase> check_lattice_stress()
{
    std::vector<VerifyCase> rows;
    for (Real const k : {1.0, 2.0, 4.0}) {
        Lattice cubic, face_centred;
        cubic.law = face_centred.law = NormalLaw::modified_jkr;
        cubic.factor = face_centred.factor = k;
        cubic.cells = 4;
        face_centred.cells = 3;
        face_centred.face_centred = true;
        for (StressPoint const& point :
             {StressPoint{1e5, 2.9305225e-7, 4.03382e8}, {1e6, 6.9500137e-7, 6.09398e8}, {1e7, 2.8241812e-6, 1.23326e9}})
            add_rows(rows, cubic, point);
        for (StressPoint const& point : {StressPoint{1e5, 2.5510573e-7, 0}, {1e6, 4.2448979e-7, 0}, {1e7, 1.4605041e-6, 0}})
            add_rows(rows, face_centred, point);
    }
    return rows;
}

namespace {

/// Growth of a noise's kinetic energy.
Real growth(Lattice const& lattice, Real force, Real dt, int steps)
{
    SystemSettings settings = make_lattice(lattice, lattice.diameter() - overlap_under(force, lattice));
    for (Grain& grain : settings.grains)
        for (int axis = 0; axis < 3; ++axis) {
            grain.velocity[axis] = 1e-9 * (random_uniform(3, grain.id, axis) - 0.5);
            grain.spin[axis] = 1e-5 * (random_uniform(3, grain.id, 3 + axis) - 0.5);
        }
    settings.dt = dt;
    GrainSystem system = make_system(settings);
    Real const start = totals(system).kinetic_energy;
    advance(system, steps);
    return totals(system).kinetic_energy / start;
}

Real critical_step(Real factor)
{
    MaterialSettings material = with(sand(), 0.8, 0.2);
    material.surface_energy *= factor;
    ContactSettings const law = contact_settings(NormalLaw::jkr, DampingLaw::none, TangentialLaw::secant);
    return time_step_limits(factor * Real(0.23e-3), material, make_pair(material, material, law), 1e6).lattice;
}

} // namespace

std::vector<VerifyCase> check_coarse_step()
{
    std::vector<VerifyCase> rows;
    rows.push_back(compare({"G6 FCC, JKR, k = 1, 1 MPa", "critical step [s]", "Bloch eigenvalues with rotation"},
                           critical_step(1), 1.12116e-7, 2e-2));
    for (Real const k : {2.0, 4.0}) {
        std::string const name = fmt::format("G6 FCC, JKR, k = {}, 1 MPa", k);
        rows.push_back(compare({name, "critical step / that of k = 1", "closed form: k"},
                               critical_step(k) / critical_step(1), k, 1e-12));
        Lattice lattice;
        lattice.face_centred = true;
        lattice.law = NormalLaw::modified_jkr;
        lattice.factor = k;
        lattice.cells = 4;
        Real const force = 0.018703 * k * k, limit = 1.12116e-7 * k;
        rows.push_back(expect_true({name, "0.98 k dt_c, 1500 steps: stable", "Bloch eigenvalues with rotation"},
                                   growth(lattice, force, 0.98 * limit, 1500) < 100));
        rows.push_back(expect_true({name, "1.02 k dt_c, 100 steps: diverges", "Bloch eigenvalues with rotation"},
                                   growth(lattice, force, 1.02 * limit, 100) > 1e6));
    }
    return rows;
}

} // namespace arenite
