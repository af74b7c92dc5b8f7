// SPDX-License-Identifier: MIT
// JKR contacts: the curve, its works, and the life of an adhering contact.
#include "apps/verify/checks.hpp"
#include "apps/verify/coarse_checks.hpp"
#include "apps/verify/grain_system.hpp"
#include "apps/verify/jkr_reference.hpp"
#include "apps/verify/sphere_on_plane.hpp"
#include "core/random.hpp"

#include <fmt/format.h>

#include <limits>
#include <numbers>

namespace arenite {
namespace {

constexpr Real sand_radius = 0.115e-3; // m

/// Coarse-grained sand has k times the surface energy.
PairConstants sand_pair(NormalLaw law, Real factor = 1)
{
    MaterialSettings material = sand();
    material.surface_energy *= factor;
    return make_pair(material, material, contact_settings(law));
}

/// Integral of the tension [J] from S + from_t^2 to A in t = sqrt(overlap / L - that of S), where it is smooth.
Real peel_work(PairConstants const& pair, ContactScale<> const& scale, Real from_t)
{
    Real const length = pair.length_factor / scale.inverse_cube_root;
    Real const end = std::sqrt(-jkr_points::overlap_S);
    constexpr int intervals = 2000;
    Real const width = (end - from_t) / intervals;
    Real sum = 0;
    for (int n = 0; n <= intervals; ++n) { // Simpson's rule
        Real const t = from_t + n * width, weight = n == 0 || n == intervals ? 1 : (n % 2 ? 4 : 2);
        sum -= weight * 2 * t * jkr_response((jkr_points::overlap_S + t * t) * length, scale, pair).force;
    }
    return sum * width / 3 * length;
}

} // namespace

std::vector<VerifyCase> check_jkr_points()
{
    PairConstants const pair = sand_pair(NormalLaw::jkr);
    ContactScale<> const scale = contact_scale(sand(), sand_radius, sand_radius);
    JkrPoints const points = jkr_points_of(pair, scale.effective_radius);
    auto const force = [&](Real overlap) { return jkr_response(overlap, scale, pair).force / points.pull_off_force; };
    Real const h = 1e-4 * points.length; // the third derivative leaves 1e-9
    Real const stiffness = (force(points.overlap_B + h) - force(points.overlap_B - h)) / (2 * h) * points.pull_off_force;
    std::string const name = "JKR, two 0.23 mm grains", source = "Johnson, Kendall & Roberts 1971";
    constexpr Real rounding = 1e-12;
    // At S the slope is infinite: a rounding of the overlap there moves the force by its root.
    Real const at_S = 10 * std::sqrt(std::numeric_limits<Real>::epsilon());
    return {
        compare({name, "pull-off force F_C [N]", source}, jkr_response(points.overlap_C, scale, pair).pull_off_force,
                1.625774198e-2, 1e-9),
        compare({name, "F / F_C at C", source}, force(points.overlap_C), -1, rounding),
        compare({name, "F / F_C at A", source}, force(0), Real(-8) / 9, rounding),
        compare({name, "F / F_C at B", source}, force(points.overlap_B), 0, rounding),
        compare({name, "F / F_C at S", source}, force(points.overlap_S), Real(-5) / 9, at_S),
        compare({name, "overlap at C [m]", source}, pair.length_factor / scale.inverse_cube_root * jkr_points::overlap_C,
                -9.256171344e-8, 1e-9),
        compare({name, "contact radius at C [m]", source}, jkr_response(points.overlap_C, scale, pair).contact_radius,
                3.995859804e-6, 1e-9),
        compare({name, "stiffness at B [N/m]", source}, stiffness, 83644.37876, 1e-7),
    };
}

std::vector<VerifyCase> check_jkr_curve()
{
    PairConstants const pair = sand_pair(NormalLaw::jkr);
    ContactScale<> const scale = contact_scale(sand(), sand_radius, sand_radius);
    JkrPoints const points = jkr_points_of(pair, scale.effective_radius);
    auto const error_at = [&](Real scaled) {
        Real const length = pair.length_factor / scale.inverse_cube_root, overlap = scaled * length;
        Real const force = jkr_response(overlap, scale, pair).force / points.pull_off_force;
        return static_cast<Real>(std::fabs(force - reference_force(static_cast<long double>(overlap) / length)));
    };
    Real along = 0, near_S = 0;
    constexpr Real unit = -jkr_points::overlap_C; // |delta_C| / L
    for (int n = 0; n < 100000; ++n) {
        Real const u = random_uniform(1, n, 0);
        along = std::fmax(along, error_at(jkr_points::overlap_S + u * (100 * unit - jkr_points::overlap_S)));
        // Distances from S of 1e-6 to 1: closer, the overlap's own rounding counts for more than 1e-12.
        near_S = std::fmax(near_S, error_at(jkr_points::overlap_S + std::pow(Real(10), -6 * u)));
    }
    std::string const source = "bisection in long double, 1e5 points";
    return {compare_error({"JKR curve, S to 100 |delta_C|", "largest error / F_C", source}, along, 1e-12),
            compare_error({"JKR curve near S", "largest error / F_C", source}, near_S, 1e-12)};
}

std::vector<VerifyCase> check_work_of_peeling()
{
    PairConstants const pair = sand_pair(NormalLaw::jkr);
    ContactScale<> const scale = contact_scale(sand(), sand_radius, sand_radius);
    Real const unit = jkr_points_of(pair, scale.effective_radius).peel_unit;
    Real const t_C = std::sqrt(jkr_points::overlap_C - jkr_points::overlap_S);
    std::string const quantity = "work / (gamma^5 R*^4/E*^2)^(1/3)";
    return {compare({"peeling from A to C", quantity, "paper eq 26, recomputed"}, peel_work(pair, scale, t_C) / unit,
                    11.1200681, 1e-8),
            compare({"peeling from A to S", quantity, "Thornton & Ning 1998: 7.09 x (2 gamma)^(5/3)"},
                    peel_work(pair, scale, 0) / unit, 22.516318693, 1e-8)};
}

namespace {

struct Pull {
    Real peak = 0;            // N, largest tension
    Real last_overlap = 0;    // m, where it still held
    bool silent = true;       // no force after the break
    bool stays_broken = true; // Hertz when pressed again
};

/// Opens a bonded pair at 1e-3 m/s from B to beyond S, then presses it together again.
Pull pull_apart(NormalLaw law)
{
    PairConstants const pair = sand_pair(law);
    ContactScale<> const scale = contact_scale(sand(), sand_radius, sand_radius);
    JkrPoints const points = jkr_points_of(pair, scale.effective_radius);
    CementedSand const contact_law;
    ContactState<> state;
    state.adhering = 1;
    constexpr int steps = 40000;
    Real const distance = points.overlap_B - 1.5 * points.overlap_S, move = distance / steps, dt = move / 1e-3;
    Pull pull;
    for (int n = 0; n <= steps; ++n) {
        Real const overlap = points.overlap_B - n * move;
        Vec3 const force = contact_law({{0, 0, 1}, overlap, {1e-3, {}}, scale}, pair, state, dt);
        if (state.touching) pull.last_overlap = overlap;
        else pull.silent = pull.silent && force == Vec3{};
        pull.peak = std::fmax(pull.peak, -force.z);
    }
    for (int n = 0; n <= 100; ++n) {
        Real const overlap = n * points.overlap_B / 100;
        Vec3 const force = contact_law({{0, 0, 1}, overlap, {}, scale}, pair, state, dt);
        Real const hertz =
            overlap > 0 ? hertz_response(overlap, scale.effective_radius, pair.effective_youngs_modulus).force : 0;
        pull.stays_broken = pull.stays_broken && force.z == hertz && !state.adhering;
    }
    return pull;
}

} // namespace

std::vector<VerifyCase> check_pull()
{
    JkrPoints const points = jkr_points_of(sand_pair(NormalLaw::jkr), sand_radius / 2);
    Pull const bond = pull_apart(NormalLaw::modified_jkr), contact = pull_apart(NormalLaw::jkr);
    std::string const source = "Johnson, Kendall & Roberts 1971; paper section 2.2";
    constexpr Real one_step = 1.2e-4; // of the overlap at C: (delta_B - 1.5 delta_S) / 40000 steps
    return {
        compare({"modified JKR, pulled", "peak tension [N]", source}, bond.peak, 1.625774198e-2, 1e-6),
        compare({"modified JKR, pulled", "overlap at the break [m]", source}, bond.last_overlap, points.overlap_C,
                2 * one_step),
        expect_true({"modified JKR, broken", "no force, then Hertz when pressed", source}, bond.silent && bond.stays_broken),
        compare({"full JKR, pulled", "peak tension [N]", source}, contact.peak, 1.625774198e-2, 1e-6),
        compare({"full JKR, pulled", "overlap at the snap [m]", source}, contact.last_overlap, points.overlap_S, one_step),
        expect_true({"full JKR, snapped", "no force, bonds again at a touch", source},
                    contact.silent && !contact.stays_broken),
    };
}

namespace {

/// Relative speed after two equal grains met (full JKR) or opened from A (modified JKR); 0 if they hold.
Real speed_after(NormalLaw law, Real speed, Real step_over_period, Real factor = 1)
{
    SphereOnPlane pair = make_collinear_pair(sand_pair(law, factor), sand(), factor * sand_radius);
    bool const meets = law == NormalLaw::jkr;
    pair.velocity = {0, 0, meets ? -speed : speed};
    pair.state.adhering = 1;
    constexpr Real period = 1.978980066e-6; // s, of small oscillations about B
    evaluate_force(pair, 0);
    for (int n = 0; n < static_cast<int>(20 / step_over_period); ++n) {
        step(pair, factor * period * step_over_period);
        if (!pair.state.touching) return pair.velocity.z;
    }
    return 0;
}

constexpr Real stick_speed = 0.8401248541; // m/s, kinetic energy = work from A to S

} // namespace

std::vector<VerifyCase> check_sticking()
{
    std::vector<VerifyCase> rows;
    for (Real const ratio : {0.5, 0.99, 1.01, 2.0, 5.0}) {
        Real const speed = ratio * stick_speed;
        Real const reference = ratio > 1 ? std::sqrt(speed * speed - stick_speed * stick_speed) : 0;
        Real const out = speed_after(NormalLaw::jkr, speed, 1e-4);
        rows.push_back(
            compare({fmt::format("full JKR, V = {} V_s", ratio), ratio > 1 ? "rebound speed / V" : "sticks: speed / V",
                     "Thornton & Ning 1998: sqrt(V^2 - V_s^2)"},
                    out / speed, reference / speed, ratio > 1 ? 1e-3 : 0));
    }
    return rows;
}

std::vector<VerifyCase> check_bonded_release()
{
    constexpr Real hold_speed = 0.5904034181; // m/s, kinetic energy = work from A to C
    std::vector<VerifyCase> rows;
    for (Real const ratio : {0.9, 1.1, 3.0}) {
        Real const speed = ratio * hold_speed;
        Real const reference = ratio > 1 ? std::sqrt(speed * speed - hold_speed * hold_speed) : 0;
        rows.push_back(compare({fmt::format("bond opened from A at {} V_hold", ratio),
                                ratio > 1 ? "speed / V" : "holds: speed / V", "energy: sqrt(V^2 - V_hold^2)"},
                               speed_after(NormalLaw::modified_jkr, speed, 1e-4) / speed, reference / speed,
                               ratio > 1 ? 1e-3 : 0));
    }
    return rows;
}

std::vector<VerifyCase> check_bonded_oscillation()
{
    // At B, where y^3 = 3, the stiffness is 6/5 E* a and that of the dashpot 2 E* a: their ratio, and with it the damping
    // ratio sqrt(5/6) beta sqrt(2 / (6/5)), is the same for all grains.
    constexpr Real restitution = 0.8;
    Real const reference = 5 * damping_ratio(restitution) / (3 * std::numbers::sqrt2_v<Real>);
    MaterialSettings const material = with(sand(), restitution, 0);
    SystemSettings settings;
    settings.materials = {material};
    settings.contact = contact_settings(NormalLaw::modified_jkr, DampingLaw::restitution);
    settings.start_bonded = true;
    settings.skin = sand_radius / 10;
    JkrPoints const points = jkr_points_of(make_pair(material, material, settings.contact), sand_radius / 2);
    Real const frequency = std::sqrt(points.stiffness_B / (sphere_mass(material, sand_radius) / 2)); // undamped, rad/s
    constexpr int steps = 5000, periods = 2;
    settings.dt = 2 * std::numbers::pi_v<Real> / frequency / steps;
    Real const distance_B = 2 * sand_radius - points.overlap_B;
    Real const speed = 1e-4 * std::fabs(points.overlap_C) * frequency; // small: the curve is straight
    settings.grains = {make_grain(0, {distance_B / 2, 0, 0}, 2 * sand_radius, {speed / 2, 0, 0}),
                       make_grain(1, {-distance_B / 2, 0, 0}, 2 * sand_radius, {-speed / 2, 0, 0})};
    GrainSystem system = make_system(settings);
    advance(system, periods * steps);

    std::vector<Grain> const grains = grains_by_id(system);
    Real const x = norm(grains[0].position - grains[1].position) - distance_B,
               v = grains[0].velocity.x - grains[1].velocity.x;
    // The amplitude, times the damped frequency, from where an oscillator is and how fast.
    Real const amplitude = std::hypot(x * frequency * std::sqrt(1 - reference * reference), v + reference * frequency * x);
    return {compare({"bond about B, e = 0.8", "damping ratio", "closed form: 5 / (3 sqrt 2) beta"},
                    std::log(speed / amplitude) / (frequency * settings.dt * periods * steps), reference, 1e-3)};
}

std::vector<VerifyCase> check_coarse_grained_pair()
{
    Real force_error = 0, work_error = 0;
    PairConstants const fine = sand_pair(NormalLaw::jkr);
    ContactScale<> const fine_scale = contact_scale(sand(), sand_radius, sand_radius);
    Real const fine_work = peel_work(fine, fine_scale, 0);
    Real const pull_off = jkr_points_of(fine, fine_scale.effective_radius).pull_off_force;
    for (Real const k : {2.0, 3.0, 4.0}) {
        PairConstants const coarse = sand_pair(NormalLaw::jkr, k);
        ContactScale<> const scale = contact_scale(sand(), k * sand_radius, k * sand_radius);
        for (int n = 0; n <= 100; ++n) {
            Real const overlap = (-0.5 + 0.1 * n) * fine.length_factor / fine_scale.inverse_cube_root;
            Real const small = jkr_response(overlap, fine_scale, fine).force;
            Real const large = jkr_response(k * overlap, scale, coarse).force;
            force_error = std::fmax(force_error, std::fabs(large / (k * k) - small) / pull_off);
        }
        work_error = std::fmax(work_error, std::fabs(peel_work(coarse, scale, 0) / (k * k * k * fine_work) - 1));
    }
    std::string const source = "paper section 2.3: F ~ k^2, overlap ~ k, work ~ k^3";
    return {compare_error({"G1 grains of k = 2, 3, 4", "|F(k) / k^2 - F(1)| / F_C", source}, force_error, 1e-12),
            compare_error({"G1 grains of k = 2, 3, 4", "|W(k) / k^3 W(1) - 1|", source}, work_error, 1e-12)};
}

std::vector<VerifyCase> check_coarse_speeds()
{
    // The speeds at which grains stick and bonds hold are those of the originals: what is left is too.
    std::vector<VerifyCase> rows;
    for (Real const k : {2.0, 4.0}) {
        std::string const name = fmt::format("G1 pair of k = {}", k),
                          source = "the same at k = 1: V_s = 0.84, V_hold = 0.59 m/s";
        for (auto const& [law, speed, quantity] :
             {std::tuple{NormalLaw::jkr, 1.01 * stick_speed, "rebound speed at 1.01 V_s [m/s]"},
              {NormalLaw::jkr, 2 * stick_speed, "rebound speed at 2 V_s [m/s]"},
              {NormalLaw::modified_jkr, 1.2 * 0.5904034181, "speed of a bond opened at 1.2 V_hold [m/s]"}})
            rows.push_back(
                compare({name, quantity, source}, speed_after(law, speed, 1e-3, k), speed_after(law, speed, 1e-3), 1e-10));
        rows.push_back(compare_error({name, "sticks: rebound speed at 0.99 V_s [m/s]", source},
                                     speed_after(NormalLaw::jkr, 0.99 * stick_speed, 1e-3, k), 0));
    }
    return rows;
}

} // namespace arenite
