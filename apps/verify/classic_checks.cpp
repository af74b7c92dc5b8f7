// SPDX-License-Identifier: MIT
// Cases of other codes and of the literature: the bouncing sphere and the squeezed pair of MFIX's manual, the
// tangential stiffness of Mindlin & Deresiewicz, and contacts at the exact points where they begin and end.
#include "apps/verify/checks.hpp"
#include "apps/verify/grain_system.hpp"
#include "apps/verify/jkr_reference.hpp"
#include "apps/verify/sphere_on_plane.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

namespace arenite {

std::vector<VerifyCase> check_bouncing()
{
    // Dropped from 0.5 m, radius 0.1 m; the flights are parabolas, the contacts are stepped, with gravity.
    std::vector<VerifyCase> rows;
    constexpr Real g = 9.81, radius = 0.1, drop = 0.4;
    for (Real const e : {0.9, 0.7, 0.5}) {
        MaterialSettings const material = with(make_material(2600, 7e10, 0.3), e, 0);
        MaterialSettings rigid = material;
        rigid.rigid = true;
        PairConstants const pair = make_pair(material, rigid, contact_settings(NormalLaw::hertz, DampingLaw::restitution));
        Real speed = std::sqrt(2 * g * drop);
        for (int bounce = 1; bounce <= 4; ++bounce) {
            SphereOnPlane sphere = make_sphere_on_plane(pair, material, radius);
            sphere.velocity = {0, 0, -speed};
            sphere.gravity = {0, 0, -g};
            constexpr int steps = 20000; // the dashpot is of first order in dt
            run_impact(sphere, hertz_impact(sphere.scale, pair.effective_youngs_modulus, speed).duration / steps,
                       20 * steps);
            speed = sphere.velocity.z;
            Real const apex = radius + speed * speed / (2 * g), hard = radius + drop * std::pow(e, 2 * bounce);
            rows.push_back(compare({fmt::format("D9 bouncing sphere, e = {}", e), fmt::format("apex {} [m]", bounce),
                                    "MFIX DEM02: hard sphere"},
                                   apex, hard, 1e-3));
        }
    }
    return rows;
}

namespace {

struct Squeezed {
    Real stiffness[3]; // 4/3 E* sqrt(R*) of lower wall-grain, grain-grain, grain-upper wall, N/m^(3/2)
    Real mass[2];
    Real gap[3]; // m between centres at which they touch
    Real top;    // height of the upper held grain's centre
    /// d(z1, v1, z2, v2)/dt
    std::array<Real, 4> slope(std::array<Real, 4> const& y) const
    {
        auto const force = [&](int c, Real distance) {
            Real const overlap = gap[c] - distance;
            return overlap > 0 ? stiffness[c] * overlap * std::sqrt(overlap) : 0;
        };
        Real const below = force(0, y[0]), between = force(1, y[2] - y[0]), above = force(2, top - y[2]);
        return {y[1], (below - between) / mass[0] - Real(9.81), y[3], (between - above) / mass[1] - Real(9.81)};
    }
};

/// Runge-Kutta of fourth order.
void integrate(Squeezed const& system, std::array<Real, 4>& y, Real dt, int steps)
{
    auto const moved = [&](std::array<Real, 4> const& slope, Real by) {
        std::array<Real, 4> next = y;
        for (int c = 0; c < 4; ++c) next[c] += by * slope[c];
        return next;
    };
    for (int n = 0; n < steps; ++n) {
        auto const a = system.slope(y), b = system.slope(moved(a, dt / 2)), c = system.slope(moved(b, dt / 2)),
                   d = system.slope(moved(c, dt));
        for (int q = 0; q < 4; ++q) y[q] += dt / 6 * (a[q] + 2 * b[q] + 2 * c[q] + d[q]);
    }
}

/// Two stacked spheres of 1 mm between two held ones, in 1.8 mm; densities 20000 and 10000. Error of the heights.
Real squeezed_error(Real dt, int steps)
{
    constexpr Real d = 1e-3, top = 2.8e-3;
    SystemSettings settings;
    settings.materials = {make_material(20000, 1e7, 0.3), make_material(10000, 1e7, 0.3)};
    settings.contact = contact_settings(NormalLaw::hertz);
    settings.grains = {make_grain(0, {0, 0, 0}, d), make_grain(1, {0, 0, 0.95e-3}, d), make_grain(2, {0, 0, 1.87e-3}, d),
                       make_grain(3, {0, 0, top}, d)};
    settings.grains[2].material = 1;
    for (int held : {0, 3}) settings.grains[held].motion = Motion::held;
    settings.box.upper = {d, d, 3e-3};
    settings.skin = 2e-4;
    settings.dt = dt;
    settings.gravity = {0, 0, -9.81};
    GrainSystem system = make_system(settings);
    advance(system, steps);
    Real const stiffness = Real(4) / 3 * 1e7 / (2 * 0.91) * std::sqrt(d / 4);
    Squeezed const reference{{stiffness, stiffness, stiffness},
                             {sphere_mass(settings.materials[0], d / 2), sphere_mass(settings.materials[1], d / 2)},
                             {d, d, d},
                             top};
    std::array<Real, 4> y{0.95e-3, 0, 1.87e-3, 0};
    constexpr int finer = 20;
    integrate(reference, y, dt / finer, steps * finer);
    std::vector<Grain> const grains = grains_by_id(system);
    return std::fmax(std::fabs(grains[1].position.z - y[0]), std::fabs(grains[2].position.z - y[2])) / d;
}

} // namespace

std::vector<VerifyCase> check_squeezed_pair()
{
    // About three periods of 2e-4 s; Hertz contacts in place of MFIX's linear springs, which no law here has.
    Real const coarse = squeezed_error(2e-7, 3000), fine = squeezed_error(1e-7, 6000);
    std::string const name = "D10 two spheres squeezed between held ones",
                      source = "MFIX DEM03's set-up; Runge-Kutta, 20 times the steps";
    return {compare_error({name, "error of the heights / diameter, dt 1e-7 s", source}, fine, 1e-5),
            compare({name, "order in time", "velocity Verlet: 2"}, std::log2(coarse / fine), 2, 0.1)};
}

std::vector<VerifyCase> check_partial_slip()
{
    // The secant spring has the no-slip stiffness of Mindlin until it slides; Mindlin & Deresiewicz's contact slips
    // from its edge inwards, so that the model is stiffer: at 0.9 mu F_n by the ratio below. Stated, not a fault.
    MaterialSettings const material = with(sand(), 1, 0.2);
    PairConstants const pair =
        make_pair(material, material, contact_settings(NormalLaw::hertz, DampingLaw::none, TangentialLaw::secant));
    ContactScale<> const scale = contact_scale(material, 0.115e-3, 0.115e-3);
    constexpr Real overlap = 1e-7, share = 0.9;
    NormalResponse<> const normal = hertz_response(overlap, scale.effective_radius, pair.effective_youngs_modulus);
    Real const stiffness = 8 * pair.effective_shear_modulus * normal.contact_radius, limit = pair.friction * normal.force;
    DrySand const law;
    ContactState<> state;
    state.previous_radius = normal.contact_radius;
    Real const move = share * limit / stiffness;
    Vec3 const force = law({{0, 0, 1}, overlap, {0, {move, 0, 0}}, scale}, pair, state, 1);
    Real const partial = 3 * limit / (2 * stiffness) * (1 - std::pow(1 - share, Real(2) / 3));
    return {compare({"T2 sheared at constant F_n to 0.9 mu F_n", "tangential stiffness / 8 G* a", "Mindlin 1949: no slip"},
                    -force.x / move / stiffness, 1, 1e-12),
            compare({"T2 sheared at constant F_n to 0.9 mu F_n", "displacement / that with partial slip",
                     "Mindlin & Deresiewicz 1953: the model is stiffer"},
                    move / partial, share / (Real(1.5) * (1 - std::pow(1 - share, Real(2) / 3))), 1e-12)};
}

std::vector<VerifyCase> check_exact_touch()
{
    constexpr Real radius = 0.115e-3;
    std::vector<VerifyCase> rows;
    std::string const source = "defined branch";
    auto const respond = [&](NormalLaw chosen, Real overlap, bool adhering) {
        MaterialSettings const material = with(sand(), 0.8, 0.2);
        PairConstants const pair =
            make_pair(material, material, contact_settings(chosen, DampingLaw::restitution, TangentialLaw::secant));
        ContactState<> state;
        state.adhering = adhering;
        ContactGeometry<> const contact{{0, 0, 1}, overlap, {}, contact_scale(sand(), radius, radius)};
        Vec3 const force =
            chosen == NormalLaw::hertz ? DrySand{}(contact, pair, state, 1e-9) : CementedSand{}(contact, pair, state, 1e-9);
        return std::pair{force.z, static_cast<bool>(state.touching)};
    };
    MaterialSettings const material = sand();
    JkrPoints const points = jkr_points_of(make_pair(material, material, contact_settings(NormalLaw::jkr)), radius / 2);
    auto const after = [](Real x) { return std::nextafter(x, Real(1)); };
    auto const before = [](Real x) { return std::nextafter(x, Real(-1)); };
    auto const row = [&](std::string const& quantity, bool holds) {
        rows.push_back(expect_true({"H12 contact at an exact point", quantity, source}, holds));
    };
    row("Hertz at overlap 0: does not touch, no force", respond(NormalLaw::hertz, 0, false) == std::pair{Real(0), false});
    row("Hertz 1 ulp above 0: touches, finite force", std::isfinite(respond(NormalLaw::hertz, after(0), false).first) &&
                                                          respond(NormalLaw::hertz, after(0), false).second);
    // The points themselves are rounded: three ulp either side are surely beyond.
    Real above = points.overlap_C, below = points.overlap_C;
    for (int n = 0; n < 3; ++n) above = after(above), below = before(below);
    row("bond 3 ulp above delta_C: holds at -F_C",
        respond(NormalLaw::modified_jkr, above, true).second &&
            std::fabs(respond(NormalLaw::modified_jkr, above, true).first / points.pull_off_force + 1) < 1e-9);
    row("bond 3 ulp below delta_C: broken, no force",
        respond(NormalLaw::modified_jkr, below, true) == std::pair{Real(0), false});
    above = below = points.overlap_S;
    for (int n = 0; n < 3; ++n) above = after(above), below = before(below);
    row("full JKR 3 ulp above delta_S: holds",
        respond(NormalLaw::jkr, above, true).second && std::isfinite(respond(NormalLaw::jkr, above, true).first));
    row("full JKR 3 ulp below delta_S: snapped, no force",
        respond(NormalLaw::jkr, below, true) == std::pair{Real(0), false});

    SystemSettings settings; // equal centres: no normal, but a defined state without NaN
    settings.materials = {with(sand(), 0.8, 0.2)};
    settings.contact = contact_settings(NormalLaw::hertz, DampingLaw::restitution, TangentialLaw::secant);
    settings.grains = {make_grain(0, {0, 0, 0}, 2 * radius), make_grain(1, {0, 0, 0}, 2 * radius)};
    settings.skin = radius / 10;
    settings.dt = 1e-9;
    GrainSystem system = make_system(settings);
    advance(system, 10);
    std::vector<Grain> const grains = grains_by_id(system);
    row("two grains at the same place, 10 steps: finite",
        std::isfinite(norm(grains[0].position) + norm(grains[1].position) + norm(grains[0].velocity) +
                      norm(grains[1].velocity)));
    return rows;
}

} // namespace arenite
