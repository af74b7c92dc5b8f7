// SPDX-License-Identifier: MIT
#include "kernels/production.hpp"

#include <algorithm>

namespace arenite {
namespace {

KOKKOS_FUNCTION Leaving leaving(WallViews const& walls, int outlet, PeriodicBox const& domain, Vec3 const& x, Real radius)
{
    bool outside = false;
    for (int axis = 0; axis < 3; ++axis)
        outside = outside || (!domain.periodic[axis] && (x[axis] < domain.lower[axis] || x[axis] > domain.upper[axis]));
    if (outlet >= 0) {
        WallBody const& plate = walls.body(outlet);
        Vec3 const local = plate.pose.to_local(x);
        // Where the plate is the domain's face, a grain is outside before it is wholly through.
        auto const passed = [&](Real depth) {
            return hole_passed(plate.axis, walls.hole, plate.first_hole, plate.holes, local, depth);
        };
        if (plate.present && plate.holes > 0) {
            if (passed(radius) >= 0) return Leaving::produced;
            int const hole = outside ? passed(0) : -1;
            if (hole >= 0 &&
                wall_geometry::axial_position(local - walls.hole(hole).center, plate.axis).radial < walls.hole(hole).radius)
                return Leaving::produced;
        }
    }
    return outside ? Leaving::lost : Leaving::stays;
}

std::vector<Grain> gather_rows(Particles const& particles, std::vector<int> const& rows)
{
    int const count = static_cast<int>(rows.size());
    View1<int> const order(uninitialized("leaving_rows"), count);
    Kokkos::deep_copy(order, Kokkos::View<int const*, HostSpace, Kokkos::MemoryUnmanaged>(rows.data(), count));
    Particles some = particles; // Views are shared; permute makes new ones
    permute(some, order);
    std::vector<Grain> grains = download(some);
    std::sort(grains.begin(), grains.end(), [](Grain const& a, Grain const& b) { return a.id < b.id; });
    return grains;
}

} // namespace

Departures find_departures(Particles const& particles, PeriodicBox const& domain, Walls const& walls, int outlet)
{
    Departures departures;
    View1<int> const what(uninitialized("leaving"), particles.count);
    RecordView const position = particles.position;
    WallViews const views = walls.views;
    int count = 0;
    Kokkos::parallel_reduce(
        "find_departures", RangePolicy(0, particles.count),
        KOKKOS_LAMBDA(int i, int& sum) {
            Leaving const where = leaving(views, outlet, domain, vector_of(position, i), position(i, 3));
            what(i) = static_cast<int>(where);
            sum += where != Leaving::stays;
        },
        count);
    if (count == 0) return departures;
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), what);
    std::vector<int> produced, lost;
    for (int i = 0; i < particles.count; ++i) {
        if (host(i) == static_cast<int>(Leaving::produced)) produced.push_back(i);
        if (host(i) == static_cast<int>(Leaving::lost)) lost.push_back(i);
        host(i) = host(i) == static_cast<int>(Leaving::stays);
    }
    departures.keep = View1<int>("keep", particles.count);
    Kokkos::deep_copy(departures.keep, host);
    if (!produced.empty()) departures.produced = gather_rows(particles, produced);
    if (!lost.empty()) departures.lost = gather_rows(particles, lost);
    return departures;
}

} // namespace arenite
