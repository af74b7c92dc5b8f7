// SPDX-License-Identifier: MIT
// Pair constants and collinear impacts: Hertz and restitution.
#include "apps/verify/checks.hpp"
#include "apps/verify/grain_system.hpp"
#include "apps/verify/sphere_on_plane.hpp"

#include <fmt/format.h>

namespace arenite {

std::vector<VerifyCase> check_pair_constants()
{
    MaterialSettings const material = with(sand(), 0.8, 0.2);
    PairConstants const pair = make_pair(material, material, contact_settings(NormalLaw::hertz, DampingLaw::restitution));
    constexpr Real rounding = 1e-14; // a few operations
    constexpr Real printed = 1e-5;   // the references have five digits
    return {
        compare({"two sand grains", "E* [Pa]", "closed form: E/(2(1-nu^2))"}, pair.effective_youngs_modulus,
                2e10 / (2 * 0.91), rounding),
        compare({"two sand grains", "G* [Pa]", "closed form: E/(4(1+nu)(2-nu))"}, pair.effective_shear_modulus,
                2e10 / (4 * 1.3 * 1.7), rounding),
        compare({"e = 0.8", "damping ratio", "paper eq 33 with ln^2 e"}, damping_ratio(0.8), 0.0708504, printed),
        compare({"sand, 0.23 mm", "Rayleigh time [s]", "paper eqs 37, 38 with 1+nu"}, rayleigh_time(material, 0.115e-3),
                2.27168e-7, printed),
    };
}

namespace {

/// Two equal spheres head-on through the grain kernels: largest force, largest overlap, duration.
HertzImpact measure_impact(MaterialSettings const& material, Real radius, Real speed, Real dt, int most)
{
    SystemSettings settings;
    settings.materials = {material};
    settings.contact = contact_settings(NormalLaw::hertz);
    settings.grains = {make_grain(0, {-radius, 0, 0}, 2 * radius, {speed / 2, 0, 0}),
                       make_grain(1, {radius, 0, 0}, 2 * radius, {-speed / 2, 0, 0})};
    settings.skin = radius / 10;
    settings.dt = dt;
    GrainSystem system = make_system(settings);
    HertzImpact found{0, 0, 0};
    Real previous = 0;
    for (int n = 1; n <= most; ++n) {
        advance(system, 1);
        std::vector<Grain> const grains = grains_by_id(system);
        Real const overlap = 2 * radius - norm(grains[0].position - grains[1].position);
        if (overlap > found.overlap) {
            found.overlap = overlap;
            found.force = Kokkos::fabs(force_on(system, 0).x);
        }
        if (overlap <= 0 && n > 1) {
            found.duration = dt * (n - 1 + previous / (previous - overlap));
            break;
        }
        previous = overlap;
    }
    return found;
}

std::vector<VerifyCase> head_on(std::string const& name, MaterialSettings const& material, HertzImpact const& reference)
{
    constexpr Real radius = 0.01, speed = 20, limit = 1e-6;
    constexpr int steps = 2000; // a contact, as the limit is stated for
    HertzImpact const found = measure_impact(material, radius, speed, reference.duration / steps, 2 * steps);
    std::string const source = "Chung & Ooi 2011 test 1; Hertz closed form";
    return {compare({name, "largest force [N]", source}, found.force, reference.force, limit),
            compare({name, "largest overlap [m]", source}, found.overlap, reference.overlap, limit),
            compare({name, "duration [s]", source}, found.duration, reference.duration, limit)};
}

VerifyCase on_rigid_plane(std::string const& name, MaterialSettings const& material, MaterialSettings const& plane,
                          Real force)
{
    PairConstants const pair = make_pair(material, plane, contact_settings(NormalLaw::hertz));
    SphereOnPlane sphere = make_sphere_on_plane(pair, material, 0.1);
    sphere.velocity = {0, 0, -0.2};
    Real const dt = hertz_impact(sphere.scale, pair.effective_youngs_modulus, 0.2).duration / 2000;
    Real largest = 0;
    for (int n = 0; n < 2000; ++n) {
        step(sphere, dt);
        largest = Kokkos::fmax(largest, sphere.force.z);
    }
    return compare({name, "largest force [N]", "Chung & Ooi 2011 test 2; Hertz closed form"}, largest, force, 1e-6);
}

} // namespace

std::vector<VerifyCase> check_hertz_impacts()
{
    std::vector<VerifyCase> rows =
        head_on("glass on glass, 20 m/s", make_material(2800, 4.8e10, 0.2), {2.74112702e-4, 10696.889, 4.03394532e-5});
    for (VerifyCase const& row : head_on("limestone on limestone, 20 m/s", make_material(2500, 2e10, 0.25),
                                         {3.68304026e-4, 7108.24128, 5.42010015e-5}))
        rows.push_back(row);
    MaterialSettings const magnesium = make_material(1800, 4e10, 0.35), aluminium = make_material(2699, 7e10, 0.3);
    MaterialSettings rigid;
    rigid.rigid = true;
    rows.push_back(on_rigid_plane("magnesium on a rigid plane", magnesium, rigid, 7232.68103));
    rows.push_back(on_rigid_plane("aluminium on a rigid plane", aluminium, rigid, 11369.8583));
    rows.push_back(on_rigid_plane("magnesium on a plane of 1000 E", magnesium, stiffer(magnesium, 1000), 7229.78998));
    rows.push_back(on_rigid_plane("aluminium on a plane of 1000 E", aluminium, stiffer(aluminium, 1000), 11365.3135));
    return rows;
}

namespace {

Real rebound_speed(Real restitution, DampingLaw damping, int steps_per_contact)
{
    MaterialSettings const material = with(make_material(4000, 3.8e11, 0.23), restitution, 0);
    PairConstants const pair = make_pair(material, material, contact_settings(NormalLaw::hertz, damping));
    SphereOnPlane sphere = make_sphere_on_plane(pair, material, 2.5e-3);
    Real const speed = 3.9;
    sphere.velocity = {0, 0, -speed};
    Real const dt = hertz_impact(sphere.scale, pair.effective_youngs_modulus, speed).duration / steps_per_contact;
    run_impact(sphere, dt, 20 * steps_per_contact);
    return sphere.velocity.z / speed;
}

/// Of a grain against an equal one that no force moves.
Real rebound_speed_from_held(Real restitution, Motion motion, int steps_per_contact)
{
    MaterialSettings const material = with(make_material(4000, 3.8e11, 0.23), restitution, 0);
    Real const radius = 2.5e-3, speed = 3.9;
    SystemSettings settings;
    settings.materials = {material};
    settings.contact = contact_settings(NormalLaw::hertz, DampingLaw::restitution);
    settings.skin = radius / 10;
    settings.grains = {make_grain(0, {0, 0, 0}, 2 * radius), make_grain(1, {0, 0, 2 * radius}, 2 * radius, {0, 0, -speed})};
    settings.grains[0].motion = motion;
    ContactScale<> scale = contact_scale(material, radius, radius);
    scale.effective_mass = sphere_mass(material, radius);
    PairConstants const pair = make_pair(material, material, settings.contact);
    settings.dt = hertz_impact(scale, pair.effective_youngs_modulus, speed).duration / steps_per_contact;
    GrainSystem system = make_system(settings);
    advance(system, 5 * steps_per_contact);
    return grains_by_id(system)[1].velocity.z / speed;
}

} // namespace

std::vector<VerifyCase> check_restitution()
{
    std::vector<VerifyCase> rows;
    constexpr int steps = 20000; // the dashpot sees the velocity half a step early: first order in dt
    constexpr Real limit = 1e-4;
    for (Real const e : {0.2, 0.4, 0.6, 0.8, 0.9})
        rows.push_back(compare({fmt::format("e = {}", e), "rebound speed / speed", "Tsuji 1992 with the attractive tail: e"},
                               rebound_speed(e, DampingLaw::restitution, steps), e, limit));
    for (Motion const motion : {Motion::held, Motion::prescribed})
        rows.push_back(compare({motion == Motion::held ? "e = 0.5 from a held grain" : "e = 0.5 from a moved grain",
                                "rebound speed / speed", "closed form: e, as from a wall"},
                               rebound_speed_from_held(0.5, motion, steps), 0.5, limit));
    Real const clipped[][2] = {
        {0.2, 0.324862848}, {0.4, 0.47201398}, {0.6, 0.632290516}, {0.8, 0.808099335}, {0.9, 0.902026069}};
    for (auto const& [e, out] : clipped)
        rows.push_back(compare({fmt::format("e = {}, force clipped at 0", e), "rebound speed / speed",
                                "the clipped equation of motion integrated to 1e-11"},
                               rebound_speed(e, DampingLaw::restitution_clipped, steps), out, limit));
    return rows;
}

} // namespace arenite
