// SPDX-License-Identifier: MIT
// Oblique impacts on a stiff plane (Chung & Ooi 2011, tests 4 to 6) against the same equations of motion
// integrated by an independent program with 40000 steps a contact.
#include "apps/verify/checks.hpp"
#include "apps/verify/sphere_on_plane.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>

namespace arenite {
namespace {

constexpr int steps_per_contact = 10000;
constexpr Real limit = 2e-3; // of the reference, as the gate of these tests is stated

struct Impact {
    MaterialSettings material;
    TangentialLaw tangential;
    DampingLaw damping;
    Real radius, normal_speed, tangential_speed, spin;
};

SphereOnPlane rebound(Impact const& impact)
{
    PairConstants const pair = make_pair(impact.material, stiffer(impact.material, 1000),
                                         contact_settings(NormalLaw::hertz, impact.damping, impact.tangential));
    SphereOnPlane sphere = make_sphere_on_plane(pair, impact.material, impact.radius);
    sphere.velocity = {impact.tangential_speed, 0, -impact.normal_speed};
    sphere.spin = {0, -impact.spin, 0}; // positive adds to the slip
    Real const duration = hertz_impact(sphere.scale, pair.effective_youngs_modulus, impact.normal_speed).duration;
    run_impact(sphere, duration / steps_per_contact, 20 * steps_per_contact);
    return sphere;
}

/// Test 4: constant speed 3.9 m/s, e = 0.98, mu = 0.092; dashpot and spring share the Coulomb limit.
void add_constant_speed(std::vector<VerifyCase>& rows, std::string const& name, MaterialSettings const& material,
                        std::vector<std::array<Real, 3>> const& references)
{
    for (auto const& [degrees, tangential_restitution, spin] : references) {
        Real const angle = degrees * std::numbers::pi_v<Real> / 180;
        SphereOnPlane const after = rebound({material, TangentialLaw::secant, DampingLaw::restitution, 2.5e-3,
                                             3.9 * std::cos(angle), 3.9 * std::sin(angle), 0});
        std::string const label = fmt::format("{} at {} degrees", name, degrees),
                          source = "Chung & Ooi 2011 test 4, recomputed";
        rows.push_back(compare({label, "tangential restitution", source}, after.velocity.x / (3.9 * std::sin(angle)),
                               tangential_restitution, limit));
        rows.push_back(compare({label, "spin [rad/s]", source}, -after.spin.y, spin, limit));
    }
}

/// Test 5: constant normal speed, e = 1, mu = 0.3; slip after impact for tangential over normal speed.
void add_constant_normal_speed(std::vector<VerifyCase>& rows, std::string const& name, TangentialLaw law,
                               std::vector<std::array<Real, 2>> const& references)
{
    MaterialSettings const steel = with(make_material(7850, 2.08e11, 0.3), 1, 0.3);
    for (auto const& [ratio, slip] : references) {
        SphereOnPlane const after = rebound({steel, law, DampingLaw::none, 1e-5, 5, ratio * 0.3 * 5, 0});
        Real const out = (after.velocity.x - after.radius * after.spin.y) / (0.3 * after.velocity.z);
        rows.push_back(compare({fmt::format("steel, {}, v_t / mu v_n = {}", name, ratio), "slip / mu v_n after",
                                "Chung & Ooi 2011 test 5, recomputed"},
                               out, slip, limit));
    }
}

} // namespace

std::vector<VerifyCase> check_oblique_impacts()
{
    std::vector<VerifyCase> rows;
    add_constant_speed(rows, "alumina", with(make_material(4000, 3.8e11, 0.23), 0.98, 0.092),
                       {{1, 0.985807891, -0.965977152},
                        {5, 0.94728661, -17.917671},
                        {10, 0.702189594, -201.685514},
                        {20, 0.62262207, -503.376329},
                        {30, 0.684989232, -614.270997},
                        {60, 0.89482557, -355.22654}});
    add_constant_normal_speed(rows, "secant", TangentialLaw::secant, {{0.1, 0.0954776858}, {0.5, 0.475218498}, {8, 1}});
    add_constant_normal_speed(rows, "rescaled", TangentialLaw::rescaled, {{0.1, 0.0623604662}, {0.5, 0.31180132}, {8, 1}});
    add_constant_normal_speed(rows, "incremental", TangentialLaw::incremental,
                              {{0.1, 0.0891996118}, {0.5, 0.363700918}, {8, 1}});
    return rows;
}

std::vector<VerifyCase> check_spinning_impacts()
{
    MaterialSettings const aluminium = with(make_material(2700, 7e10, 0.33), 0.5, 0.4);
    std::vector<VerifyCase> rows;
    Real const references[][2] = {{0.27, 0.0359096622}, {1, -0.278017616}, {2.75, 1.15920777}};
    for (auto const& [ratio, recoil] : references) {
        SphereOnPlane const after =
            rebound({aluminium, TangentialLaw::secant, DampingLaw::restitution, 0.1, 0.2, 0, ratio * 0.2 / 0.1});
        Real const out = (after.velocity.x - after.radius * after.spin.y) / after.velocity.z;
        rows.push_back(compare({fmt::format("aluminium, spin only, slip / v_n = {}", ratio), "slip / v_n after",
                                "Chung & Ooi 2011 test 6, recomputed"},
                               out, recoil, 5e-3));
    }
    return rows;
}

} // namespace arenite
