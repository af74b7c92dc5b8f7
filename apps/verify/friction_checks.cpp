// SPDX-License-Identifier: MIT
// The tangential spring: cycles, turns with the contact, rolling and sliding.
#include "apps/verify/checks.hpp"
#include "apps/verify/grain_system.hpp"
#include "apps/verify/sphere_on_plane.hpp"
#include "core/random.hpp"

#include <fmt/format.h>

#include <numbers>

namespace arenite {
namespace {

constexpr Real pi = std::numbers::pi_v<Real>;

struct FrictionCycle {
    Real loop_area = 0;   // J, of the last of three cycles
    Real force_error = 0; // largest | |F_t| - min(k_t xi, mu F_n) | / mu F_n while loading
};

/// Constant normal force, driven to and fro by amplitude times the slip at which sliding starts.
FrictionCycle run_friction_cycle(PairConstants const& pair, ContactScale<> const& scale, Real overlap, int amplitude)
{
    constexpr int per_yield = 100; // steps from rest to sliding, so that every corner falls on a step
    NormalResponse<> const normal = hertz_response(overlap, scale.effective_radius, pair.effective_youngs_modulus);
    Real const limit = pair.friction * normal.force, stiffness = 8 * pair.effective_shear_modulus * normal.contact_radius;
    Real const move = limit / stiffness / per_yield;
    DrySand const law;
    ContactState<> state;
    FrictionCycle cycle;
    Real force = 0;
    auto const drive = [&](int steps, int direction) {
        Real work = 0;
        for (int n = 0; n < steps; ++n) {
            Vec3 const all = law({{0, 0, 1}, overlap, {0, {direction * move, 0, 0}}, scale}, pair, state, 1);
            work -= Real(0.5) * (force + all.x) * direction * move;
            force = all.x;
            if (direction > 0 && n < per_yield && steps == amplitude * per_yield)
                cycle.force_error = std::fmax(cycle.force_error, std::fabs(-force - stiffness * (n + 1) * move) / limit);
        }
        return work;
    };
    drive(amplitude * per_yield, 1);
    for (int n = 0; n < 3; ++n) cycle.loop_area = drive(2 * amplitude * per_yield, -1) + drive(2 * amplitude * per_yield, 1);
    cycle.force_error = std::fmax(cycle.force_error, std::fabs(-force - limit) / limit);
    return cycle;
}

} // namespace

std::vector<VerifyCase> check_friction_cycle()
{
    MaterialSettings const material = with(sand(), 1, 0.2);
    PairConstants const pair =
        make_pair(material, material, contact_settings(NormalLaw::hertz, DampingLaw::none, TangentialLaw::secant));
    ContactScale<> const scale = contact_scale(material, 0.115e-3, 0.115e-3);
    constexpr Real overlap = 1e-7;
    constexpr int amplitude = 5;
    NormalResponse<> const normal = hertz_response(overlap, scale.effective_radius, pair.effective_youngs_modulus);
    Real const limit = 0.2 * normal.force, yield = limit / (8 * pair.effective_shear_modulus * normal.contact_radius);
    FrictionCycle const cycle = run_friction_cycle(pair, scale, overlap, amplitude);
    std::string const source = "closed form: elastic-sliding parallelogram";
    return {compare_error({"sheared to and fro at constant F_n", "| |F_t| - min(k_t xi, mu F_n) | / mu F_n", source},
                          cycle.force_error, 1e-12),
            compare({"sheared to and fro at constant F_n", "loop area [J]", source}, cycle.loop_area,
                    4 * limit * (amplitude - 1) * yield, 1e-12)};
}

namespace {

/// A contact that sticks, pressed and sheared at will; work is what the tangential force took.
struct ShearedContact {
    PairConstants pair;
    ContactScale<> scale = contact_scale(sand(), 0.115e-3, 0.115e-3);
    ContactState<> state;
    Vec3 place;    // m, tangential displacement
    Real work = 0; // J

    explicit ShearedContact(TangentialLaw law)
        : pair(make_pair(with(sand(), 1, 0.2), with(sand(), 1, 0.2),
                         contact_settings(NormalLaw::hertz, DampingLaw::none, law)))
    {
        pair.friction = 1e9;
    }
    Vec3 force(Real overlap, Vec3 const& move)
    {
        Vec3 const all = DrySand{}({{0, 0, 1}, overlap, {0, move}, scale}, pair, state, 1);
        return {all.x, all.y, 0};
    }
    void shear(Real overlap, Vec3 const& to)
    {
        Vec3 const move = to - place, before = force(overlap, {}), after = force(overlap, move);
        work -= dot(Real(0.5) * (before + after), move);
        place = to;
    }
    Real stiffness(Real overlap) const
    {
        return 8 * pair.effective_shear_modulus *
               hertz_response(overlap, scale.effective_radius, pair.effective_youngs_modulus).contact_radius;
    }
};

/// Least work over closed paths in the plane of overlap and displacement, over the stiffest spring's energy at the
/// largest displacement.
Real least_closed_work(TangentialLaw law, int paths)
{
    constexpr Real deepest = 1e-7, farthest = 1e-10; // m
    constexpr int corners = 12;
    Real least = 0;
    for (int path = 0; path < paths; ++path) {
        ShearedContact contact(law);
        auto const draw = [&](int corner, int which) { return random_uniform(7, path, 3 * corner + which); };
        Real overlap = deepest;
        for (int corner = 0; corner < corners; ++corner) {
            overlap = deepest * (Real(0.01) + Real(0.99) * draw(corner, 0));
            contact.shear(overlap, farthest * Vec3{2 * draw(corner, 1) - 1, 2 * draw(corner, 2) - 1, 0});
        }
        contact.shear(overlap, {}); // back where it began; opening then frees what the spring still holds
        least = std::fmin(least, contact.work / (contact.stiffness(deepest) * farthest * farthest / 2));
    }
    return least;
}

/// Sheared at one overlap, back at another: work over that of the stiffer spring.
Real cycle_work(TangentialLaw law, Real out, Real back)
{
    constexpr Real slip = 1e-12;
    ShearedContact contact(law);
    contact.shear(out, {slip, 0, 0});
    contact.shear(back, {});
    return contact.work / (contact.stiffness(std::fmax(out, back)) * slip * slip);
}

} // namespace

std::vector<VerifyCase> check_shear_paths()
{
    constexpr Real light = 1e-8, heavy = 4e-8; // contact radii 1 : 2
    std::string const source = "closed form: k xi^2 of linear springs", name = "sheared and pressed, sticking";
    return {
        compare({name, "dissipative: work of shear, press, back", source},
                cycle_work(TangentialLaw::dissipative, light, heavy), 0.25, 1e-10),
        compare({name, "dissipative: work of shear, release, back", source},
                cycle_work(TangentialLaw::dissipative, heavy, light), 0.25, 1e-10),
        compare_error({name, "dissipative: energy made on 1000 closed paths", "second law: none"},
                      -least_closed_work(TangentialLaw::dissipative, 1000), 1e-12),
        compare({name, "secant: work of shear, press, back", source}, cycle_work(TangentialLaw::secant, light, heavy), -0.25,
                1e-10),
        compare({name, "incremental: work of shear, release, back", source},
                cycle_work(TangentialLaw::incremental, heavy, light), -0.25, 1e-10),
    };
}

namespace {

Vec3 turned(Vec3 const& v, Vec3 const& axis, Real angle)
{
    Real const c = std::cos(angle), s = std::sin(angle);
    return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
}

/// m, of a system with one contact.
Vec3 only_spring(GrainSystem const& system)
{
    ListedPair const pair = listed_pairs(system)[0];
    return {pair.spring[0], pair.spring[1], pair.spring[2]};
}

struct TurnDrift {
    Real size, direction; // of the tangential force, relative, per turn
};

/// Loads a contact of two grains tangentially, then turns both as one rigid body about an axis.
TurnDrift turn_loaded_pair(Vec3 const& axis, Vec3 const& loading_spin)
{
    constexpr Real radius = 0.115e-3, overlap = 1e-7;
    constexpr int turns = 10, steps_per_turn = 4000;
    SystemSettings settings;
    settings.materials = {with(sand(), 1, 0.5)};
    settings.contact = contact_settings(NormalLaw::hertz, DampingLaw::none, TangentialLaw::secant);
    Vec3 const start{radius - overlap / 2, 0, 0};
    settings.grains = {make_grain(0, start, 2 * radius), make_grain(1, -start, 2 * radius)};
    settings.skin = radius / 10;
    settings.dt = 1e-8;
    GrainSystem system = make_system(settings);
    for (GrainId id : {0, 1}) place(system, id, id == 0 ? start : -start, {}, loading_spin);
    evaluate(system);
    Vec3 const loaded = only_spring(system);
    Real const rate = 2 * pi / steps_per_turn / settings.dt;
    for (int n = 1; n <= turns * steps_per_turn; ++n) {
        Vec3 const before = turned(start, axis, 2 * pi * (n - 1) / steps_per_turn);
        Vec3 const here = turned(start, axis, 2 * pi * n / steps_per_turn), velocity = (here - before) / settings.dt;
        for (GrainId id : {0, 1}) place(system, id, id == 0 ? here : -here, id == 0 ? velocity : -velocity, rate * axis);
        evaluate(system);
    }
    Vec3 const after = only_spring(system);
    return {std::fabs(norm(after) / norm(loaded) - 1) / turns, norm(after - loaded) / norm(loaded) / turns};
}

} // namespace

std::vector<VerifyCase> check_rigid_turns()
{
    // Slip of 1e-8 m in one step: a quarter of what friction 0.5 allows.
    Real const spin = 1e-8 / (0.23e-3 * 1e-8);
    TurnDrift const in_plane = turn_loaded_pair({0, 0, 1}, {0, 0, spin});
    TurnDrift const axial = turn_loaded_pair({0, 0, 1}, {0, spin, 0});
    TurnDrift const skew = turn_loaded_pair({0.28, 0, 0.96}, {0, spin, 0});
    std::string const source = "closed form: a rigid turn leaves |F_t|", size = "change of |F_t| a turn",
                      direction = "change of F_t a turn";
    return {compare_error({"pair turned 10 times, F_t in the plane", size, source}, in_plane.size, 1e-8),
            compare_error({"pair turned 10 times, F_t along the axis", size, source}, axial.size, 1e-8),
            compare_error({"pair turned 10 times, axis askew", size, source}, skew.size, 1e-8),
            // The twist is that of the step's middle: second order in the step's angle, 1.6e-3 here.
            compare_error({"pair turned 10 times, axis askew", direction, source}, skew.direction, 1e-5)};
}

namespace {

/// A 1 mm sphere, soft and strongly damped, resting on a tilted plane.
SphereOnPlane resting_sphere(Real slope, Real friction)
{
    constexpr Real g = 9.81, radius = 0.5e-3;
    MaterialSettings const material = with(make_material(2600, 1e7, 0.3), 0.3, friction);
    MaterialSettings rigid = material;
    rigid.rigid = true;
    PairConstants const pair =
        make_pair(material, rigid, contact_settings(NormalLaw::hertz, DampingLaw::restitution, TangentialLaw::secant));
    SphereOnPlane sphere = make_sphere_on_plane(pair, material, radius);
    sphere.gravity = {g * std::sin(slope), 0, -g * std::cos(slope)};
    Real const weight = -sphere.mass * sphere.gravity.z;
    sphere.position.z = -std::pow(3 * weight / (4 * pair.effective_youngs_modulus * std::sqrt(radius)), Real(2) / 3);
    evaluate_force(sphere, 0);
    return sphere;
}

} // namespace

std::vector<VerifyCase> check_incline()
{
    constexpr Real g = 9.81, mu = 0.2, dt = 1e-6, limit = 1e-4;
    constexpr int half = 50000;
    std::vector<VerifyCase> rows;
    for (Real const degrees : {5.0, 20.0, 50.0}) {
        Real const slope = degrees * pi / 180;
        SphereOnPlane sphere = resting_sphere(slope, mu);
        for (int n = 0; n < half; ++n) step(sphere, dt);
        Vec3 const speed = sphere.velocity, spin = sphere.spin;
        for (int n = 0; n < half; ++n) step(sphere, dt);
        bool const rolls = std::tan(slope) <= 3.5 * mu;
        Real const acceleration = rolls ? Real(5) / 7 * g * std::sin(slope) : g * (std::sin(slope) - mu * std::cos(slope));
        Real const turning = rolls ? acceleration / sphere.radius : 5 * mu * g * std::cos(slope) / (2 * sphere.radius);
        std::string const name = fmt::format("sphere {} down {} degrees", rolls ? "rolls" : "slides", degrees);
        rows.push_back(compare({name, "acceleration [m/s2]", "closed form: rigid sphere, Coulomb"},
                               (sphere.velocity.x - speed.x) / (half * dt), acceleration, limit));
        rows.push_back(compare({name, "angular acceleration [rad/s2]", "closed form: rigid sphere, Coulomb"},
                               (sphere.spin.y - spin.y) / (half * dt), turning, limit));
    }
    return rows;
}

std::vector<VerifyCase> check_sliding_to_rolling()
{
    constexpr Real g = 9.81, mu = 0.2, start = 0.1, dt = 1e-6;
    SphereOnPlane sphere = resting_sphere(0, mu);
    sphere.velocity.x = start;
    int steps = 0;
    do {
        step(sphere, dt);
        ++steps;
    } while (sphere.force.x < -0.99 * mu * sphere.mass * g || steps < 1000);
    int const slipped = steps;
    for (int n = 0; n < 20000; ++n) step(sphere, dt); // the spring's swing dies away
    std::string const source = "MFIX DEM04 (Garg et al. 2012): 2/7, 5/7";
    return {
        compare({"sliding sphere comes to roll", "mu g t / u0", source}, mu * g * slipped * dt / start, Real(2) / 7, 1e-3),
        compare({"sliding sphere comes to roll", "u / u0", source}, sphere.velocity.x / start, Real(5) / 7, 1e-5),
        compare({"sliding sphere comes to roll", "R omega / u0", source}, sphere.radius * sphere.spin.y / start, Real(5) / 7,
                1e-5)};
}

namespace {

/// How far [m] the surfaces slip in a step of 1e-7 s where two spheres of radii 1 : 3, whose centres are at rest, turn about
/// axes across the line of centres: at these speeds [m/s] of their surfaces in the plane of contact.
Real slip_of_unequal_gears(Real small_speed, Real large_speed)
{
    constexpr Real small = 0.05, large = 0.15, distance = small + large - 1e-5;
    constexpr Real arm = (distance + (small * small - large * large) / distance) / 2; // of the small one
    SystemSettings settings;
    settings.materials = {with(make_material(2700, 7e10, 0.33), 1, 1e3)};
    settings.contact = contact_settings(NormalLaw::hertz, DampingLaw::none, TangentialLaw::secant);
    settings.grains = {make_grain(0, {}, 2 * small, {}, {0, 0, small_speed / arm}),
                       make_grain(1, {distance, 0, 0}, 2 * large, {}, {0, 0, large_speed / (distance - arm)})};
    settings.skin = small / 10;
    settings.dt = 1e-7;
    GrainSystem system = make_system(settings);
    evaluate(system);
    return norm(only_spring(system));
}

} // namespace

std::vector<VerifyCase> check_gear_spin()
{
    constexpr Real radius = 0.1, spin = 5;
    SystemSettings settings;
    settings.materials = {with(make_material(2700, 7e10, 0.33), 0.5, 0.4)};
    settings.contact = contact_settings(NormalLaw::hertz, DampingLaw::restitution, TangentialLaw::secant);
    settings.grains = {make_grain(0, {-radius, 0, 0}, 2 * radius, {0.1, 0, 0}, {0, 0, spin}),
                       make_grain(1, {radius, 0, 0}, 2 * radius, {-0.1, 0, 0}, {0, 0, -spin})};
    settings.skin = radius / 10;
    settings.dt = 1e-6;
    GrainSystem system = make_system(settings);
    advance(system, 2000); // the contact lasts 1.1e-3 s
    std::vector<Grain> const grains = grains_by_id(system);
    std::string const source = "Chung & Ooi 2011 test 7: no slip", unequal = "spheres 1 : 3 turning as gears",
                      closed = "closed form: a_i omega_i + a_j omega_j";
    constexpr Real way = 1e-7; // of a surface at 1 m/s in a step
    return {
        compare_error({unequal, "slip of a step / way of a surface", closed}, slip_of_unequal_gears(1, -1) / way, 1e-12),
        compare({unequal, "the same, the larger one turning alone", closed}, slip_of_unequal_gears(0, 1) / way, 1, 1e-12),
        compare({unequal, "the same, the smaller one turning alone", closed}, slip_of_unequal_gears(1, 0) / way, 1, 1e-12),
        compare_error({"equal spheres turning as gears", "tangential speed [m/s]", source}, std::fabs(grains[0].velocity.y),
                      1e-12),
        compare({"equal spheres turning as gears", "omega_out / omega_in", source}, grains[0].spin.z / spin, 1, 1e-12),
        compare({"equal spheres turning as gears", "rebound speed / speed", "Tsuji 1992: e"}, -grains[0].velocity.x / 0.1,
                0.5, 5e-3)};
}

} // namespace arenite
