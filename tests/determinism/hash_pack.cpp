// SPDX-License-Identifier: MIT
// Prints the hash of a pack's state after some hundred steps; compare_threads.cmake runs it on one thread
// and on two. Arguments beside Kokkos' own: "periodic" for a periodic box, "tiled" for steps in parts, of a tile a thread.
#include "apps/verify/packs.hpp"

#include <cstdio>
#include <string>

namespace {

arenite::SystemSettings pack_of(std::string const& kind)
{
    arenite::SystemSettings settings =
        arenite::rough_pack(arenite::NormalLaw::jkr, 1500, 2.4e-3, 0.24e-3, kind == "periodic");
    settings.fused = kind == "tiled";
    settings.tile_grains = kind == "tiled" ? 100 : 0;
    return settings;
}

} // namespace

int main(int argc, char** argv)
{
    Kokkos::ScopeGuard const kokkos(argc, argv);
    arenite::GrainSystem system = arenite::make_system(pack_of(argc > 1 ? argv[1] : ""));
    arenite::advance(system, 150);
    std::printf("hash %016llx, %lld searches\n", static_cast<unsigned long long>(arenite::state_hash(system)),
                system.rebuilds);
    return system.rebuilds > 3 ? 0 : 1; // the search is part of what is compared
}
