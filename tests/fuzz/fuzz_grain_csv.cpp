// SPDX-License-Identifier: MIT
// The reader of grains from CSV. Grains that are accepted are finite, have a size, a material and an id of their own.
#include "core/error.hpp"
#include "io/grain_csv.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <cmath>
#include <set>
#include <sstream>

using namespace arenite;

namespace {

bool is_finite(Vec3 const& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check(GrainTable const& table, int materials)
{
    FUZZ_REQUIRE(table.grains.size() == table.lines.size());
    std::set<GrainId> ids;
    for (Grain const& grain : table.grains) {
        FUZZ_REQUIRE(grain.diameter > 0 && std::isfinite(grain.diameter));
        FUZZ_REQUIRE(is_finite(grain.position) && is_finite(grain.velocity) && is_finite(grain.spin) &&
                     is_finite(grain.applied_force));
        FUZZ_REQUIRE(grain.material >= 0 && grain.material < materials);
        FUZZ_REQUIRE(grain.size_class >= 0 && grain.size_class <= 32767); // what a View of them holds
        FUZZ_REQUIRE(grain.id < 0 || ids.insert(grain.id).second);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size)
{
    static std::vector<std::string> const materials{"sand", "steel"};
    for (int const default_material : {0, -1}) { // -1: the file must name them
        std::istringstream stream(std::string(reinterpret_cast<char const*>(data), size));
        try {
            check(parse_grain_csv(stream, "fuzzed.csv", materials, default_material), 2);
        } catch (InputError const&) {
        }
    }
    return 0;
}
