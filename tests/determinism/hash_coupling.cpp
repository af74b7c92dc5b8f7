// SPDX-License-Identifier: MIT
// The coupled step's bits: equal for any number of threads (H18).
#include "fluid/advance_flow.hpp"
#include "fluid/exchange.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <unistd.h>

namespace arenite {
namespace {

std::vector<Grain> random_grains(Region const& box, int count)
{
    std::mt19937_64 engine(2);
    std::uniform_real_distribution<Real> share(0, 1);
    std::vector<Grain> grains(count);
    for (Grain& grain : grains) {
        for (int axis = 0; axis < 3; ++axis) {
            grain.position[axis] = box.lower[axis] + share(engine) * (box.upper[axis] - box.lower[axis]);
            grain.velocity[axis] = share(engine) - 0.5;
        }
        grain.diameter = 3e-4;
    }
    return grains;
}

/// FNV-1a over the forces on the grains.
std::uint64_t hash_of(RecordView const& records)
{
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), records);
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (std::size_t n = 0; n < host.size(); ++n) {
        std::uint64_t bits;
        std::memcpy(&bits, host.data() + n, sizeof bits);
        hash = (hash ^ bits) * 0x100000001b3ULL;
    }
    return hash;
}

std::string hash_at(int threads)
{
    char self[4096] = {};
    if (readlink("/proc/self/exe", self, sizeof self - 1) <= 0) return "";
    std::string const command = "OMP_NUM_THREADS=" + std::to_string(threads) +
                                " OMP_PROC_BIND=false OMP_WAIT_POLICY=passive '" + self +
                                "' --gtest_filter=CouplingHash.Print 2>/dev/null";
    FILE* const pipe = popen(command.c_str(), "r");
    std::string found;
    char line[512];
    while (pipe && fgets(line, sizeof line, pipe))
        if (std::strncmp(line, "coupling hash", 13) == 0) found = line;
    if (pipe) pclose(pipe);
    return found;
}

} // namespace

TEST(CouplingHash, Print)
{
    Region const box{{0, 0, 0}, {9e-3, 7e-3, 8e-3}};
    FluidSettings fluid;
    fluid.cells = {9, 7, 8};
    Particles particles = make_particles(random_grains(box, 5000), {2605});
    Flow flow = make_flow(fluid, box, true, {0, 0, -9.81});
    FlowBoundary const boundary = make_boundary(fluid, flow.grid);
    FlowSolver solver = make_flow_solver(fluid, flow);
    Exchange exchange = make_exchange(flow, particles, fluid, 1);
    for (int step = 0; step < 3; ++step) {
        deposit_porosity(flow, exchange, particles);
        deposit_drag(flow, exchange, particles, 1e-5);
        advance_flow(flow, boundary, solver, 1e-5);
        evaluate_fluid_force(flow, solver, exchange, particles);
    }
    std::printf("coupling hash %llx\n", static_cast<unsigned long long>(hash_of(particles.fluid_force)));
}

TEST(CouplingHash, AnyNumberOfThreads)
{
    std::string const one = hash_at(1);
    ASSERT_FALSE(one.empty());
    for (int const threads : {2, 3}) EXPECT_EQ(one, hash_at(threads));
}

} // namespace arenite
