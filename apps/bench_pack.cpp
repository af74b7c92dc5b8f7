// SPDX-License-Identifier: MIT
#include "apps/bench_pack.hpp"

#include "apps/view_memory.hpp"
#include "core/error.hpp"
#include "core/random.hpp"
#include "kernels/contact_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

namespace arenite {
namespace {

using Clock_ = std::chrono::steady_clock;

double seconds_between(Clock_::time_point a, Clock_::time_point b) { return std::chrono::duration<double>(b - a).count(); }

std::vector<WallSettings> bench_walls(BenchPack const& pack)
{
    std::vector<WallSettings> walls;
    auto const add = [&](char const* name, Vec3 const& point, Vec3 const& normal) {
        WallSettings wall;
        wall.name = name;
        wall.material = "sand";
        wall.point = point;
        wall.normal = normal;
        walls.push_back(wall);
    };
    add("x_lower", pack.lower, {1, 0, 0});
    add("x_upper", pack.upper, {-1, 0, 0});
    add("y_lower", pack.lower, {0, 1, 0});
    add("y_upper", pack.upper, {0, -1, 0});
    add("floor", pack.lower, {0, 0, 1});
    return walls;
}

unsigned long long hash_state(Particles const& particles)
{
    std::vector<Grain> grains = download(particles);
    std::sort(grains.begin(), grains.end(), [](Grain const& a, Grain const& b) { return a.id < b.id; });
    unsigned long long hash = 1469598103934665603ull;
    auto const add = [&](Vec3 const& v) {
        for (int axis = 0; axis < 3; ++axis) {
            unsigned long long bits;
            Real const value = v[axis];
            std::memcpy(&bits, &value, sizeof bits);
            hash = (hash ^ bits) * 1099511628211ull;
        }
    };
    for (Grain const& grain : grains) {
        add(grain.position);
        add(grain.velocity);
        add(grain.spin);
    }
    return hash;
}

/// The state with its lists, laws bound, forces evaluated.
struct PreparedPack {
    RunState state;
    PlannedStage planned;
    StageForces forces;
    StepSettings step;
    bool whole_steps = false;

    void search()
    {
        SearchSettings settings{state.skin, forces.needs, {}, whole_steps};
        settings.forces_follow = true;
        search_contacts(state.particles, state.box, settings, state.contacts);
        search_wall_contacts(state.particles, state.walls, state.skin, forces.wall_needs, state.wall_contacts);
    }
    void move(ContactPass const& pass)
    {
        kick_and_drift(state.integrator, step, state.particles, state.contacts, force_rows(state.wall_contacts), pass);
    }
};

void prepare(BenchPack const& pack, BenchSettings const& settings, PreparedPack& prepared)
{
    RunState& state = prepared.state;
    state.particles = make_particles(pack.grains, {2605});
    state.box.lower = pack.lower;
    state.box.upper = pack.upper;
    state.walls = make_walls(bench_walls(pack), {{"sand"}, pack.lower, pack.upper, {}});
    begin_stage(state.walls, {});
    state.skin = settings.skin;
    prepared.whole_steps = settings.whole_steps;
    ContactSettings contact;
    contact.normal = settings.law;
    contact.break_point = BreakPoint::S;
    MaterialSettings const sand = bench_sand(settings.surface_energy);
    prepared.planned.pairs = {make_pair(sand, sand, contact)};
    prepared.planned.wall_pairs = {make_pair(sand, sand, {})};
    prepared.forces = make_stage_forces(prepared.planned, -1, state);
    prepared.step.dt = settings.dt;
    prepared.step.gravity = {0, 0, -settings.gravity};
    prepared.step.allowed_move = settings.skin / 2;
    prepared.search();
    evaluate_all(prepared.forces, state, 0);
    StepSettings still = prepared.step;
    still.dt = 0;
    kick(state.integrator, still, state.particles, state.contacts, force_rows(state.wall_contacts));
    drift(state.integrator, prepared.step, state.particles, state.contacts);
}

/// On return all of them are made, also on a device.
void make_steps(PreparedPack& prepared, long long steps, BenchRun& run)
{
    RunState& state = prepared.state;
    for (long long made = 0;; ++made) {
        auto const t0 = Clock_::now();
        if (made == steps || says_stale(state.integrator)) {
            int const in_vain = take_stale(state.integrator);
            if (made == steps && in_vain < 0) return;
            made -= std::max(in_vain, 0);
            prepared.search();
            ++run.searches;
            if (made == steps) return;
        }
        auto const t1 = Clock_::now();
        run.seconds_search += seconds_between(t0, t1);
        prepared.forces.evaluate_walls(prepared.step.dt);
        auto before = t1;
        for_each_pass(state.contacts, [&](ContactPass const& pass) {
            prepared.forces.evaluate_pass(pass, prepared.step.dt);
            auto const evaluated = Clock_::now();
            prepared.move(pass);
            auto const moved = Clock_::now();
            run.seconds_evaluate += seconds_between(before, evaluated);
            run.seconds_integrate += seconds_between(evaluated, moved);
            before = moved;
        });
    }
}

} // namespace

MaterialSettings bench_sand(double surface_energy)
{
    MaterialSettings sand;
    sand.name = "sand";
    sand.density = 2605;
    sand.youngs_modulus = 2e10;
    sand.poissons_ratio = 0.3;
    sand.restitution = 0.8;
    sand.friction = 0.2;
    sand.surface_energy = surface_energy;
    return sand;
}

BenchPack read_pack(std::string const& path)
{
    std::ifstream file(path);
    if (!file) throw InputError(fmt::format("{}: cannot be opened", path));
    BenchPack pack;
    pack.name = path.substr(path.find_last_of('/') + 1);
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream fields(line);
        Grain grain;
        Real radius = 0;
        if (!(fields >> grain.position.x >> grain.position.y >> grain.position.z >> radius))
            throw InputError(fmt::format("{}:{}: expected x y z radius", path, number));
        grain.diameter = 2 * radius;
        for (int axis = 0; axis < 3; ++axis) pack.upper[axis] = std::fmax(pack.upper[axis], grain.position[axis] + radius);
        pack.grains.push_back(grain);
    }
    for (int axis = 0; axis < 3; ++axis) pack.upper[axis] = std::round(pack.upper[axis] * 1e4) / 1e4;
    return pack;
}

BenchPack lattice_pack(int grains, std::array<int, 3> const& proportions)
{
    constexpr Real diameter = 0.46e-3, spacing = diameter - 4e-7;
    double const unit = std::cbrt(static_cast<double>(grains) / (1.0 * proportions[0] * proportions[1] * proportions[2]));
    int along[3];
    for (int axis = 0; axis < 3; ++axis) along[axis] = std::max(2, static_cast<int>(std::lround(unit * proportions[axis])));
    BenchPack pack;
    int const count = along[0] * along[1] * along[2];
    pack.name = fmt::format("lattice{}", count);
    pack.grains.reserve(count);
    for (int k = 0; k < along[2]; ++k)
        for (int j = 0; j < along[1]; ++j)
            for (int i = 0; i < along[0]; ++i) {
                Grain grain;
                grain.diameter = diameter;
                std::uint64_t const n = pack.grains.size();
                Vec3 const jitter{random_uniform(1, n, 0), random_uniform(1, n, 1), random_uniform(1, n, 2)};
                grain.position = Vec3{i + Real(0.5), j + Real(0.5), k + Real(0.5)} * spacing + 1e-8 * jitter;
                pack.grains.push_back(grain);
            }
    pack.upper = spacing * Vec3{Real(along[0]), Real(along[1]), Real(along[2])};
    return pack;
}

BenchPack tiled_pack(BenchPack const& pack, int along_x, int along_y)
{
    BenchPack tiled;
    tiled.name = fmt::format("{} x {} {}", along_x, along_y, pack.name);
    auto const placed = [](Real x, Real side, int tile) { return tile * side + (tile % 2 == 0 ? x : side - x); };
    for (int i = 0; i < along_x; ++i)
        for (int j = 0; j < along_y; ++j)
            for (Grain grain : pack.grains) {
                grain.position.x = placed(grain.position.x, pack.upper.x, i);
                grain.position.y = placed(grain.position.y, pack.upper.y, j);
                tiled.grains.push_back(grain);
            }
    tiled.upper = {along_x * pack.upper.x, along_y * pack.upper.y, pack.upper.z};
    return tiled;
}

void write_pack(BenchPack const& pack, std::string const& path)
{
    std::ofstream file(path);
    file << "# x y z radius (m)\n";
    for (Grain const& grain : pack.grains)
        file << fmt::format("{:.15g} {:.15g} {:.15g} {:.9g}\n", grain.position.x, grain.position.y, grain.position.z,
                            grain.diameter / 2);
    file.flush();
    if (!file) throw SimulationError(fmt::format("{}: cannot be written", path));
}

BenchPack relaxed_pack(BenchPack const& pack, BenchSettings const& settings, int steps)
{
    PreparedPack prepared;
    prepare(pack, settings, prepared);
    prepared.step.local_damping = 0.7;
    BenchRun unused;
    make_steps(prepared, steps, unused);
    BenchPack relaxed = pack;
    relaxed.grains = download(prepared.state.particles);
    for (Grain& grain : relaxed.grains) grain.velocity = grain.spin = {};
    return relaxed;
}

/// Rows of forces that a step gathers, each on two sides.
double gathered_rows(ContactList const& contacts)
{
    ContactList const list = contacts;
    int entries = 0;
    Kokkos::parallel_reduce(
        "gathered_rows", RangePolicy(0, list.grains()),
        KOKKOS_LAMBDA(int i, int& sum) {
            sum += list.incident_begin(i + 1) - list.incident_begin(i);
            if (list.awake(i)) sum += list.incident_begin(list.grains() + i + 1) - list.incident_begin(list.grains() + i);
        },
        entries);
    return 0.5 * entries;
}

BenchRun run_pack(BenchPack const& pack, BenchSettings const& settings)
{
    ViewMemory const memory;
    PreparedPack prepared;
    prepare(pack, settings, prepared);
    RunState& state = prepared.state;
    BenchRun run;
    run.grains = state.particles.count;
    make_steps(prepared, settings.warm_up, run);
    run = BenchRun{};
    run.grains = state.particles.count;
    Clock_::time_point begin = Clock_::now();
    make_steps(prepared, settings.steps, run);
    run.seconds = seconds_between(begin, Clock_::now());
    run.steps = settings.steps;
    run.tile_grains = state.contacts.tile_grains;
    run.candidates_per_grain = static_cast<double>(state.contacts.count) / run.grains;
    run.gathered_per_grain = gathered_rows(state.contacts) / run.grains;
    double shared = 0;
    for_each_pass(state.contacts, [&](ContactPass const& pass) { shared += pass.force_row.count; });
    run.shared_per_grain = shared / run.grains;
    run.contacts_per_grain = static_cast<double>(prepared.forces.report().touching) / run.grains;
    run.state_hash = hash_state(state.particles);
    run.memory = memory.by_label();
    begin = Clock_::now();
    prepared.search();
    Kokkos::fence();
    run.one_search = seconds_between(begin, Clock_::now());
    run.peak_memory = memory.peak();
    return run;
}

} // namespace arenite
