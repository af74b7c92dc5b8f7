// SPDX-License-Identifier: MIT
// The fluid's bits: equal for any number of threads (H18) and across a restart (H17).
#include "apps/verify/fluid_case.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <unistd.h>

using namespace arenite;

namespace {

FluidCase make_hashed_case(bool with_grains)
{
    FluidSettings settings = box_settings({14, 11, 9}, {14e-3, 11e-3, 9e-3});
    add_periodic_axis(settings, 0);
    settings.patches.push_back(face_patch(Face::y_lower, PatchKind::velocity, {0, 1e-3, 0}));
    PatchSettings hole = face_patch(Face::z_upper, PatchKind::pressure);
    hole.shape = PatchShape::disc;
    hole.center = {7e-3, 5.5e-3, 0};
    hole.diameter = 2.6e-3;
    settings.patches.push_back(hole);
    settings.convection = ConvectionScheme::limited;
    settings.porosity = 0.7;
    FluidCase c = make_fluid_case(settings, with_grains);
    if (with_grains) set_field(c.flow.grid, c.flow.drag, -1, [](Vec3 x) { return 1e5 * (2 + std::sin(900 * x.x)); });
    return c;
}

std::uint64_t hash_of(FieldView const& field)
{
    HostField const host = host_copy(field);
    std::uint64_t hash = 0xcbf29ce484222325ull;
    for (std::size_t i = 0; i < host.size(); ++i) {
        std::uint64_t bits;
        std::memcpy(&bits, host.data() + i, sizeof bits);
        hash = (hash ^ bits) * 0x100000001b3ull;
    }
    return hash;
}

std::uint64_t hash_of(FluidCase const& c)
{
    std::uint64_t hash = hash_of(c.flow.pressure);
    for (int axis = 0; axis < 3; ++axis) hash = hash * 31 + hash_of(c.flow.velocity[axis]);
    return hash;
}

TEST(FlowHash, Print)
{
    FluidCase c = make_hashed_case(true);
    c.steps(5, 1e-3);
    std::printf("flow hash %llx\n", static_cast<unsigned long long>(hash_of(c)));
}

std::string printed_hash(int threads)
{
    char self[4096] = {};
    if (readlink("/proc/self/exe", self, sizeof self - 1) <= 0) return "";
    std::string const command = "OMP_NUM_THREADS=" + std::to_string(threads) +
                                " OMP_PROC_BIND=false OMP_WAIT_POLICY=passive '" + self +
                                "' --gtest_filter=FlowHash.Print 2>/dev/null";
    FILE* const pipe = popen(command.c_str(), "r");
    std::string found;
    char line[512];
    while (pipe && fgets(line, sizeof line, pipe))
        if (std::strncmp(line, "flow hash", 9) == 0) found = line;
    if (pipe) pclose(pipe);
    return found;
}

TEST(FlowHash, AnyNumberOfThreads)
{
    std::string const one = printed_hash(1);
    ASSERT_FALSE(one.empty());
    for (int const threads : {2, 3}) EXPECT_EQ(one, printed_hash(threads));
}

struct Saved {
    std::map<std::string, HostField> fields;
    std::map<std::string, Real> numbers;
};

struct Save {
    Saved& saved;
    void operator()(std::string const& name, FieldView& field) const { saved.fields[name] = host_copy(field); }
    void operator()(std::string const& name, Real& number) const { saved.numbers[name] = number; }
};

struct Load {
    Saved const& saved;
    void operator()(std::string const& name, FieldView& field) const { Kokkos::deep_copy(field, saved.fields.at(name)); }
    void operator()(std::string const& name, Real& number) const { number = saved.numbers.at(name); }
};

TEST(FlowHash, RestartGivesTheSameBits)
{
    for (bool const with_grains : {false, true}) {
        FluidCase whole = make_hashed_case(with_grains);
        whole.steps(4, 1e-3);
        Saved saved;
        for_each_state_field(whole.flow, whole.solver, Save{saved});
        whole.steps(3, 2e-3);
        FluidCase again = make_hashed_case(with_grains);
        for_each_state_field(again.flow, again.solver, Load{saved});
        again.steps(3, 2e-3);
        EXPECT_EQ(hash_of(whole), hash_of(again));
    }
}

} // namespace
