// SPDX-License-Identifier: MIT
// The time step: free fall, conservation, order, and the largest stable step.
#include "apps/verify/checks.hpp"
#include "apps/verify/lattice.hpp"
#include "apps/verify/packs.hpp"
#include "core/random.hpp"

#include <fmt/format.h>

namespace arenite {

std::vector<VerifyCase> check_free_fall()
{
    constexpr int steps = 1000;
    SystemSettings settings;
    settings.materials = {sand()};
    settings.grains = {make_grain(0, {0, 0, 1}, 1e-3, {0.3, -0.2, 0.1})};
    settings.grains[0].applied_force = {1e-6, 0, 0};
    settings.skin = 1e-4;
    settings.dt = 1e-4;
    settings.gravity = {0, 0, -9.81};
    GrainSystem system = make_system(settings);
    advance(system, steps);
    Grain const grain = grains_by_id(system)[0];
    Real const t = steps * settings.dt, push = 1e-6 / sphere_mass(settings.materials[0], 0.5e-3);
    Vec3 const place{0.3 * t + push * t * t / 2, -0.2 * t, 1 + 0.1 * t - 9.81 * t * t / 2};
    constexpr Real rounding = 1e-13; // a thousand steps
    std::string const source = "closed form: exact for a constant force";
    return {compare_error({"constant force and gravity, 1000 steps", "error of position [m]", source},
                          norm(grain.position - place), rounding),
            compare_error({"constant force and gravity, 1000 steps", "error of velocity [m/s]", source},
                          norm(grain.velocity - Vec3{0.3 + push * t, -0.2, 0.1 - 9.81 * t}), rounding)};
}

namespace {

/// Two unlike spinning grains meet off centre, with friction and damping.
GrainSystem make_collision(std::uint64_t draw)
{
    auto const random = [&](int n) { return random_uniform(7, draw, n); };
    constexpr Real large = 0.5e-3;
    Real const small = large * std::pow(Real(10), -random(0));
    SystemSettings settings;
    settings.materials = {with(sand(), 0.3 + 0.7 * random(1), random(2))};
    settings.contact =
        contact_settings(draw % 2 ? NormalLaw::jkr : NormalLaw::hertz, DampingLaw::restitution, TangentialLaw::secant);
    Vec3 const line = normalized({0.2 + random(3), random(4), random(5)});
    Vec3 const slip = normalized(cross(line, {0, 0, 1}));
    Real const reach = (large + small) / 2 * (1 + Real(1e-6));
    settings.grains = {
        make_grain(0, 0.3 * reach * line, large, {0.1, 0.2, 0}, {900, -300, 500 * random(6)}),
        make_grain(1, 1.3 * reach * line, small, -3 * line + (1 + random(7)) * slip, {-200, 700, 1e4 * random(8)})};
    settings.skin = 1e-5;
    settings.dt = 2e-10;
    return make_system(settings);
}

} // namespace

std::vector<VerifyCase> check_pair_conservation()
{
    Real linear = 0, angular = 0;
    for (std::uint64_t draw = 0; draw < 20; ++draw) {
        GrainSystem system = make_collision(draw);
        Totals const before = totals(system);
        advance(system, 1000);
        Totals const after = totals(system);
        linear = std::fmax(linear, norm(after.momentum - before.momentum) / before.momentum_scale);
        angular = std::fmax(angular, norm(after.angular_momentum - before.angular_momentum) / before.angular_scale);
    }
    std::string const name = "20 pairs, size ratio 1 to 10, any e and mu", source = "Newton's third law";
    return {compare_error({name, "change of momentum", source}, linear, 1e-12),
            compare_error({name, "change of angular momentum", source}, angular, 1e-12)};
}

namespace {

SystemSettings smooth_gas(bool periodic)
{
    PackSettings pack;
    pack.count = 1000;
    pack.box = 2.6e-3;
    pack.largest = 0.25e-3;
    pack.size_ratio = 1.5;
    pack.speed = 1;
    pack.lattice = true;
    SystemSettings settings;
    settings.grains = random_pack(pack);
    settings.materials = {sand()};
    settings.contact = contact_settings(NormalLaw::hertz);
    settings.box.upper = {pack.box, pack.box, pack.box};
    for (bool& axis : settings.box.periodic) axis = periodic;
    settings.skin = 2e-5;
    return settings;
}

struct EnergyDrift {
    Real largest = 0; // relative departure from the start
    Real trend = 0;   // the last third's mean departure minus the first third's
};

/// Over about ten contact times.
EnergyDrift energy_drift(Real dt)
{
    SystemSettings settings = smooth_gas(true);
    settings.dt = dt;
    GrainSystem system = make_system(settings);
    Real const start = totals(system).kinetic_energy + hertz_energy(system);
    EnergyDrift drift;
    constexpr int samples = 60;
    for (int n = 0; n < samples; ++n) {
        advance(system, static_cast<int>(std::lround(1.6e-7 / dt)));
        Real const departure = (totals(system).kinetic_energy + hertz_energy(system)) / start - 1;
        drift.largest = std::fmax(drift.largest, std::fabs(departure));
        if (n < samples / 3) drift.trend -= departure / (samples / 3);
        if (n >= 2 * samples / 3) drift.trend += departure / (samples / 3);
    }
    return drift;
}

} // namespace

std::vector<VerifyCase> check_many_bodies()
{
    SystemSettings settings = smooth_gas(false);
    settings.dt = 2e-8;
    for (Grain& grain : settings.grains) grain.velocity -= 1500 * (grain.position - 0.5 * settings.box.size()); // implodes
    GrainSystem system = make_system(settings);
    Totals const before = totals(system);
    advance(system, 1500);
    Totals const after = totals(system);
    std::string const name = "1000 spheres, e = 1, mu = 0";
    constexpr Real critical = 3.2e-7; // s, 2 / omega of the smallest pairs at their largest overlap
    EnergyDrift const coarse = energy_drift(critical / 20), fine = energy_drift(critical / 80);
    return {compare_error({name + ", no walls", "change of momentum", "Newton's third law"},
                          norm(after.momentum - before.momentum) / before.momentum_scale, 1e-12),
            compare_error({name + ", no walls", "change of angular momentum", "Newton's third law"},
                          norm(after.angular_momentum - before.angular_momentum) / before.angular_scale, 1e-12),
            // Within a contact the energy swings by (omega dt)^2 / 4 = 2.5e-3 of what it stores, and comes back.
            compare_error({name + ", periodic", "energy swing at dt_c/20", "velocity Verlet: (omega dt)^2"}, coarse.largest,
                          5e-3),
            compare({name + ", periodic", "order of the energy swing", "velocity Verlet: 2"},
                    std::log2(coarse.largest / fine.largest) / 2, 2, 0.15),
            compare_error({name + ", periodic", "energy trend at dt_c/80", "symplectic: none"}, fine.trend, 1e-4)};
}

namespace {

struct CriticalLattice {
    std::string name;
    Lattice lattice;
    Real contact_force; // N
    Real critical_step; // s, from the lattice's exact eigenvalues
};

/// Growth of the noise's kinetic energy over a run at a multiple of the critical step.
Real growth(CriticalLattice const& critical, Real multiple, int steps)
{
    Lattice const& lattice = critical.lattice;
    SystemSettings settings = make_lattice(lattice, lattice.diameter() - overlap_under(critical.contact_force, lattice));
    for (Grain& grain : settings.grains)
        for (int axis = 0; axis < 3; ++axis) { // noise
            grain.velocity[axis] = 1e-9 * (random_uniform(3, grain.id, axis) - 0.5);
            grain.spin[axis] = 1e-5 * (random_uniform(3, grain.id, 3 + axis) - 0.5);
        }
    settings.dt = multiple * critical.critical_step;
    GrainSystem system = make_system(settings);
    Real const start = totals(system).kinetic_energy;
    advance(system, steps);
    return totals(system).kinetic_energy / start;
}

} // namespace

std::vector<VerifyCase> check_critical_step()
{
    std::vector<VerifyCase> rows;
    std::string const source = "Bloch eigenvalues with rotation, 1 MPa";
    Lattice const cubic{false, NormalLaw::hertz, 1, 8}, adhering_cubic{false, NormalLaw::modified_jkr, 1, 8},
        face_centred{true, NormalLaw::hertz, 1, 4}, adhering_face_centred{true, NormalLaw::modified_jkr, 1, 4};
    for (CriticalLattice const& lattice : {CriticalLattice{"D13 SC, Hertz", cubic, 0.0529, 1.75983e-7},
                                           {"D13 SC, JKR", adhering_cubic, 0.0529, 1.47518e-7},
                                           {"D13 FCC, Hertz", face_centred, 0.018703, 1.47984e-7},
                                           {"D13 FCC, JKR", adhering_face_centred, 0.018703, 1.12116e-7}}) {
        // Below the limit a mode's energy swings by up to 1/(1 - 0.98^2) = 25; above, it grows 1.9 times a step.
        rows.push_back(
            expect_true({lattice.name + ", 0.98 dt_c, 2000 steps", "stable", source}, growth(lattice, 0.98, 2000) < 100));
        rows.push_back(
            expect_true({lattice.name + ", 1.02 dt_c, 100 steps", "diverges", source}, growth(lattice, 1.02, 100) > 1e6));
    }
    return rows;
}

} // namespace arenite
