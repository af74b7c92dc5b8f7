// SPDX-License-Identifier: MIT
#include "core/particles.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <unordered_set>
#include <utility>

namespace arenite {
namespace {

void check_grains(std::vector<Grain> const& grains)
{
    std::unordered_set<GrainId> seen;
    std::string faults;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        Grain const& grain = grains[i];
        if (!(grain.diameter > 0))
            faults += fmt::format("grain {}: the diameter is {} m, it must be positive\n", i + 1, grain.diameter);
        if (grain.id >= 0 && !seen.insert(grain.id).second)
            faults += fmt::format("grain {}: the id {} occurs twice\n", i + 1, grain.id);
    }
    if (!faults.empty()) throw InputError(faults.substr(0, faults.size() - 1));
}

template <class T> void reorder(View1<T>& view, View1<int> const& order, int count)
{
    View1<T> const sorted(uninitialized(view.label()), count);
    View1<T> const source = view;
    Kokkos::parallel_for("reorder", RangePolicy(0, count), KOKKOS_LAMBDA(int row) { sorted(row) = source(order(row)); });
    view = sorted;
}

/// Into sorted, [count].
void reorder(RecordView& view, View1<int> const& order, RecordView const& sorted)
{
    RecordView const source = view;
    Kokkos::parallel_for(
        "reorder_records", RangePolicy(0, sorted.extent(0)), KOKKOS_LAMBDA(int row) {
            for (int c = 0; c < 4; ++c) sorted(row, c) = source(order(row), c);
        });
    view = sorted;
}

template <class Operation> void for_each_view(Particles& particles, Operation const& operation)
{
    operation(particles.position);
    operation(particles.velocity);
    operation(particles.spin);
    operation(particles.force);
    operation(particles.torque);
    operation(particles.id);
    operation(particles.material);
    operation(particles.size_class);
    operation(particles.motion);
    operation(particles.applied_force);
    operation(particles.fluid_force);
    operation(particles.coasting);
    operation(particles.pressure_force);
}

/// take_rows(view): where the records of that view are to be, [grains that stay].
template <class TakeRows> void reorder_views(Particles& particles, View1<int> const& order, TakeRows const& take_rows)
{
    int const count = order.extent_int(0);
    for_each_view(particles, [&](auto& view) {
        if (!view.is_allocated()) return;
        if constexpr (std::is_same_v<std::decay_t<decltype(view)>, RecordView>) reorder(view, order, take_rows(view));
        else reorder(view, order, count);
    });
    particles.count = count;
    particles.ghosts = 0;
}

} // namespace

Particles make_particles(std::vector<Grain> const& grains, std::vector<Real> const& densities)
{
    check_grains(grains);
    int const count = static_cast<int>(grains.size());
    Particles particles;
    particles.count = count;
    particles.position = RecordView("position", count);
    particles.velocity = RecordView("velocity", count);
    particles.spin = RecordView("spin", count);
    particles.force = RecordView("force", count);
    particles.torque = RecordView("torque", count);
    particles.id = View1<GrainId>("id", count);
    particles.material = View1<std::uint8_t>("material", count);
    particles.size_class = View1<std::int16_t>("size_class", count);
    particles.motion = View1<Motion>("motion", count);
    bool const has_applied =
        std::any_of(grains.begin(), grains.end(), [](Grain const& g) { return !(g.applied_force == Vec3{}); });
    if (has_applied) particles.applied_force = RecordView("applied_force", count);

    auto const position = Kokkos::create_mirror_view(particles.position);
    auto const velocity = Kokkos::create_mirror_view(particles.velocity);
    auto const spin = Kokkos::create_mirror_view(particles.spin);
    auto const applied = Kokkos::create_mirror_view(particles.applied_force);
    auto const id = Kokkos::create_mirror_view(particles.id);
    auto const material = Kokkos::create_mirror_view(particles.material);
    auto const size_class = Kokkos::create_mirror_view(particles.size_class);
    auto const motion = Kokkos::create_mirror_view(particles.motion);
    for (int i = 0; i < count; ++i) {
        Grain const& grain = grains[i];
        Real const radius = grain.diameter / 2;
        Real const mass = densities.at(grain.material) * sphere_volume(radius);
        set_vector(position, i, grain.position);
        position(i, 3) = radius;
        set_vector(velocity, i, grain.velocity);
        velocity(i, 3) = mass;
        set_vector(spin, i, grain.spin);
        spin(i, 3) = Real(0.4) * mass * radius * radius;
        id(i) = grain.id >= 0 ? grain.id : i;
        material(i) = static_cast<std::uint8_t>(grain.material);
        size_class(i) = static_cast<std::int16_t>(grain.size_class);
        motion(i) = grain.motion;
        if (has_applied) set_vector(applied, i, grain.applied_force);
    }
    Kokkos::deep_copy(particles.position, position);
    Kokkos::deep_copy(particles.velocity, velocity);
    Kokkos::deep_copy(particles.spin, spin);
    if (has_applied) Kokkos::deep_copy(particles.applied_force, applied);
    Kokkos::deep_copy(particles.id, id);
    Kokkos::deep_copy(particles.material, material);
    Kokkos::deep_copy(particles.size_class, size_class);
    Kokkos::deep_copy(particles.motion, motion);
    return particles;
}

std::vector<Grain> download(Particles const& particles)
{
    auto const position = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.position);
    auto const velocity = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.velocity);
    auto const spin = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.spin);
    auto const id = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.id);
    auto const material = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.material);
    auto const size_class = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.size_class);
    auto const motion = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.motion);
    auto const applied = Kokkos::create_mirror_view_and_copy(HostSpace(), particles.applied_force);
    std::vector<Grain> grains(particles.count);
    for (int i = 0; i < particles.count; ++i) {
        Grain& grain = grains[i];
        grain.position = vector_of(position, i);
        grain.diameter = 2 * position(i, 3);
        grain.velocity = vector_of(velocity, i);
        grain.spin = vector_of(spin, i);
        grain.material = material(i);
        grain.size_class = size_class(i);
        grain.id = id(i);
        grain.motion = motion(i);
        if (applied.is_allocated()) grain.applied_force = vector_of(applied, i);
    }
    return grains;
}

int shared_material(Particles const& particles)
{
    int lowest = -1, highest = -1;
    View1<std::uint8_t> const material = particles.material;
    if (particles.count > 0)
        Kokkos::parallel_reduce(
            "shared_material", RangePolicy(0, particles.count),
            KOKKOS_LAMBDA(int i, int& low, int& high) {
                low = Kokkos::min(low, static_cast<int>(material(i)));
                high = Kokkos::max(high, static_cast<int>(material(i)));
            },
            Kokkos::Min<int>(lowest), Kokkos::Max<int>(highest));
    return lowest == highest ? lowest : -1;
}

void permute(Particles& particles, View1<int> const& order)
{
    reorder_views(particles, order,
                  [&](RecordView const& view) { return RecordView(uninitialized(view.label()), order.extent(0)); });
}

void permute(Particles& particles, View1<int> const& order, RecordView& spare)
{
    int const count = order.extent_int(0);
    reorder_views(particles, order, [&](RecordView const& view) { return rows_of(std::exchange(spare, view), 0, count); });
    spare = rows_of(spare, 0, count);
}

} // namespace arenite
