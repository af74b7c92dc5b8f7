// SPDX-License-Identifier: MIT
// The contact search: every pair once, across faces too, and nothing that depends on when or how it is done.
#include "apps/verify/checks.hpp"
#include "apps/verify/packs.hpp"

#include <fmt/format.h>

namespace arenite {

std::vector<VerifyCase> check_pairs_found()
{
    std::vector<VerifyCase> rows;
    for (Real const ratio : {1.0, 2.4, 10.0})
        for (int periodic_axes = 0; periodic_axes <= 3; ++periodic_axes) {
            PackSettings pack;
            pack.count = 800;
            pack.size_ratio = ratio;
            pack.largest = ratio > 5 ? 2.5e-3 : 1e-3;
            pack.overhang = 2e-3;
            SystemSettings settings;
            settings.grains = random_pack(pack);
            settings.materials = {sand()};
            settings.box.upper = {pack.box, pack.box, pack.box};
            for (int axis = 0; axis < periodic_axes; ++axis) settings.box.periodic[axis] = true;
            settings.skin = 1e-4;
            GrainSystem const system = make_system(settings);
            rows.push_back(compare_error({fmt::format("800 grains, size ratio {}, {} periodic axes", ratio, periodic_axes),
                                          "wrong pairs", "every two grains"},
                                         wrong_pairs(system), 0));
        }
    return rows;
}

namespace {

/// Two rough grains that hold on to each other and travel along x, in a box that is closed or periodic.
std::vector<Grain> travel(bool periodic)
{
    constexpr Real diameter = 0.23e-3, edge = 1e-3;
    SystemSettings settings;
    settings.materials = {with(sand(), 0.8, 0.2)};
    settings.contact = contact_settings(NormalLaw::jkr, DampingLaw::restitution, TangentialLaw::secant);
    settings.grains = {
        make_grain(0, {0.8e-3, 0.5e-3, 0.5e-3}, diameter, {20, 0.2, 0}, {0, 100, 2000}),
        make_grain(1, {0.8e-3 + 0.999 * diameter, 0.5e-3, 0.5e-3}, diameter, {20, -0.2, 0.1}, {300, 0, 2000})};
    settings.box.upper = {edge, edge, edge};
    settings.box.periodic[0] = periodic;
    settings.skin = 1e-5;
    settings.dt = 1e-8;
    GrainSystem system = make_system(settings);
    advance(system, 2000); // 0.4 mm: both cross the face at 1 mm
    return grains_by_id(system);
}

} // namespace

std::vector<VerifyCase> check_periodic_crossing()
{
    std::vector<Grain> const open = travel(false), wrapped = travel(true);
    constexpr Real edge = 1e-3;
    Real place = 0, motion = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        Vec3 offset = open[i].position - wrapped[i].position;
        offset.x -= edge * std::round(offset.x / edge);
        place = std::fmax(place, norm(offset) / edge);
        motion = std::fmax(motion, norm(open[i].velocity - wrapped[i].velocity) / norm(open[i].velocity));
        motion = std::fmax(motion, norm(open[i].spin - wrapped[i].spin) / norm(open[i].spin));
    }
    bool const crossed = wrapped[0].position.x < edge / 2 && wrapped[1].position.x < edge / 2;
    return {
        expect_true({"bonded pair crosses a periodic face", "crossed", "set-up"}, crossed),
        compare_error({"bonded pair crosses a periodic face", "position / edge", "the same pair in the open"}, place, 1e-12),
        compare_error({"bonded pair crosses a periodic face", "velocity and spin", "the same pair in the open"}, motion,
                      1e-12)};
}

namespace {

GrainSystem run_pack(SystemSettings const& settings)
{
    GrainSystem system = make_system(settings);
    advance(system, 600);
    return system;
}

/// Largest distance between the same grains of two systems, over the box's edge.
Real distance_between(GrainSystem const& a, GrainSystem const& b)
{
    std::vector<Grain> const left = grains_by_id(a), right = grains_by_id(b);
    Real const edge = a.settings.box.size().x;
    Real largest = 0;
    for (std::size_t i = 0; i < left.size(); ++i)
        largest = std::fmax(largest, norm(nearest_offset(left[i].position - right[i].position, a.settings.box)) / edge);
    return largest;
}

} // namespace

std::vector<VerifyCase> check_independence()
{
    std::vector<VerifyCase> rows;
    std::string const source = "the same run";
    for (bool const periodic : {false, true}) {
        SystemSettings const settings = rough_pack(NormalLaw::jkr, 300, 1.5e-3, 0.22e-3, periodic);
        GrainSystem const reference = run_pack(settings);
        std::uint64_t const hash = state_hash(reference);
        std::string const name = fmt::format("300 rough adhering grains, {} box", periodic ? "periodic" : "open");
        SystemSettings wide = settings, often = settings, mixed = settings, fused = settings;
        wide.skin *= 2.5;
        often.rebuild_interval = 7;
        mixed.grains = shuffled(mixed.grains, 5);
        fused.fused = true;
        for (auto const& [what, changed] :
             {std::pair{"2.5 times the skin", wide}, std::pair{"a search every 7 steps", often}}) {
            GrainSystem const other = run_pack(changed);
            // A grain that crossed a face is shifted at the next search; rounding and 600 steps of collisions.
            if (periodic)
                rows.push_back(compare_error({name, fmt::format("distance / edge with {}", what), source},
                                             distance_between(reference, other), 1e-9));
            else
                rows.push_back(
                    expect_true({name, fmt::format("equal bits with {}", what), source}, state_hash(other) == hash));
        }
        rows.push_back(expect_true({name, "equal bits with rows shuffled", source}, state_hash(run_pack(mixed)) == hash));
        rows.push_back(
            expect_true({name, "equal bits with kick and drift fused", source}, state_hash(run_pack(fused)) == hash));
    }
    return rows;
}

} // namespace arenite
