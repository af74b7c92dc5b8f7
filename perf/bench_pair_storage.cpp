// SPDX-License-Identifier: MIT
// Where should a pair's force live? Two ways to evaluate the same law on the same pack, forces on every grain at the end:
//
//   contact rows   each pair once, its force into its own row, gathered per grain in fixed order (what Arenite does)
//   atomic adds    each pair once, added to both grains with atomics: the order of the sums, and so the bits, are the
//                  scheduler's; the speed that determinism is measured against
//
// A third, every grain evaluating all its pairs (no gather, twice the law, two copies of the history), took 2.4 times as
// long as contact rows with the scalar kernel of commit a4b9e2f and left with it.
//
// Usage: bench_pair_storage [--benchmark_...]; the pack is a lattice of 32 768 grains with three contacts each.
#include "apps/bench_pack.hpp"
#include "kernels/contact/contact_laws.hpp"
#include "kernels/contact_forces.hpp"
#include "kernels/contact_search.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace arenite;

struct Pack {
    Particles particles;
    PeriodicBox box;
    ContactList contacts;
    CementedSand law;
};

Pack make_pack()
{
    MaterialSettings const sand = bench_sand(60);
    ContactSettings contact;
    contact.normal = NormalLaw::jkr;
    contact.break_point = BreakPoint::S;
    Pack pack;
    BenchPack const grains = lattice_pack(32768);
    pack.particles = make_particles(grains.grains, {sand.density});
    pack.box.lower = grains.lower;
    pack.box.upper = grains.upper;
    pack.law = CementedSand{upload({make_pair(sand, sand, contact)})};
    search_contacts(pack.particles, pack.box, {3e-5, {true, true}, {}}, pack.contacts);
    return pack;
}

using Evaluation = ContactEvaluation<CementedSand, BoxKind::closed, false>;

Evaluation evaluation_of(Pack const& pack, ContactList const& contacts)
{
    return {
        pack.law, contacts, pack.particles.position, pack.particles.velocity, pack.particles.spin, pack.particles.material,
        pack.box, 1e-8};
}

/// Adds a contact's row to a grain, as the gather does.
KOKKOS_FUNCTION void add_row(ContactList const& list, int c, bool second, Vec3& force, Vec3& torque)
{
    Vec3 const pull{list.force(c, 0), list.force(c, 1), list.force(c, 2)};
    force = second ? force - pull : force + pull;
    torque -= list.force(c, second ? 7 : 3) * Vec3{list.force(c, 4), list.force(c, 5), list.force(c, 6)};
}

void contact_rows(Pack const& pack)
{
    Evaluation const evaluate = evaluation_of(pack, pack.contacts);
    Kokkos::parallel_for("evaluate_contacts", RangePolicy(0, evaluate.turns.count), evaluate);
    ContactList const list = pack.contacts;
    Particles const grains = pack.particles;
    Kokkos::parallel_for(
        "gather", RangePolicy(0, grains.count), KOKKOS_LAMBDA(int i) {
            Vec3 force, torque;
            for (int k = list.incident_begin(i); k < list.incident_begin(i + 1); ++k) { // the pack rests: no grain is awake
                int const entry = list.incident(k);
                if (list.touching(entry >> 1)) add_row(list, entry >> 1, entry & 1, force, torque);
            }
            set_vector(grains.force, i, force);
            set_vector(grains.torque, i, torque);
        });
}

void atomic_adds(Pack const& pack)
{
    Evaluation const evaluate = evaluation_of(pack, pack.contacts);
    ContactList const list = pack.contacts;
    Particles const grains = pack.particles;
    Kokkos::deep_copy(grains.force, 0);
    Kokkos::deep_copy(grains.torque, 0);
    Kokkos::parallel_for(
        "atomic_adds", RangePolicy(0, blocks_of(list)), KOKKOS_LAMBDA(int block) {
            evaluate.visit(block * lane_count);
            int const begin = block * lane_count, end = begin + lane_count < list.count ? begin + lane_count : list.count;
            for (int row = 2 * begin; row < 2 * end; ++row) {
                int const c = row / 2, side = row % 2;
                if (!list.touching(c)) continue;
                int const i = side ? list.second(c) : list.first(c);
                Vec3 force, torque;
                add_row(list, c, side, force, torque);
                for (int n = 0; n < 3; ++n) {
                    Kokkos::atomic_add(&grains.force(i, n), force[n]);
                    Kokkos::atomic_add(&grains.torque(i, n), torque[n]);
                }
            }
        });
}

void run(benchmark::State& state, void (*forces)(Pack const&))
{
    static Pack const* const pack = new Pack(make_pack()); // kept past main: Views end with Kokkos, not after it
    for (auto _ : state) {
        forces(*pack);
        Kokkos::fence();
    }
    state.counters["grains/s"] = benchmark::Counter(pack->particles.count, benchmark::Counter::kIsIterationInvariantRate);
}

} // namespace

int main(int argc, char** argv)
{
    Kokkos::ScopeGuard const kokkos(argc, argv);
    benchmark::Initialize(&argc, argv);
    benchmark::RegisterBenchmark("contact rows", run, contact_rows)->UseRealTime();
    benchmark::RegisterBenchmark("atomic adds", run, atomic_adds)->UseRealTime();
    benchmark::RunSpecifiedBenchmarks();
}
