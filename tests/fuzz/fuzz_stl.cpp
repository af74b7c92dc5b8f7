// SPDX-License-Identifier: MIT
// The STL reader, ASCII and binary, and the mesh that is made of what it accepts.
#include "core/error.hpp"
#include "io/stl.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <cmath>

using namespace arenite;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size)
{
    try {
        std::vector<Triangle> const triangles =
            parse_stl(std::string(reinterpret_cast<char const*>(data), size), "fuzzed.stl");
        FUZZ_REQUIRE(!triangles.empty());
        for (Triangle const& triangle : triangles)
            for (Vec3 const& corner : triangle.corner)
                FUZZ_REQUIRE(std::isfinite(corner.x) && std::isfinite(corner.y) && std::isfinite(corner.z));
        MeshData mesh;
        MeshPart const part = append_mesh(mesh, triangles, "fuzzed.stl");
        FUZZ_REQUIRE(part.triangles > 0 && mesh.triangles.size() == static_cast<std::size_t>(part.triangles));
    } catch (InputError const&) {
    }
    return 0;
}
