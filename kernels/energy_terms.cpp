// SPDX-License-Identifier: MIT
#include "kernels/energy_terms.hpp"

namespace arenite {
namespace {

/// A record a mechanism, whose first three numbers are the shares of the axes.
struct GrainPowerTerms {
    enum Record { mass_path, applied, drag, pressure, virial, total, records }; // the fourth of total: what holds the grain
    using Sums = QuadTerms<4 * records>;

    Particles grains;
    Quad gravity, origin, strain_rate;
    bool has_applied, has_fluid;

    KOKKOS_FORCEINLINE_FUNCTION static Quad read(RecordView const& view, int i)
    {
        return load_record(view.data() + 4 * static_cast<std::ptrdiff_t>(i));
    }

    KOKKOS_FORCEINLINE_FUNCTION Sums operator()(int i) const
    {
        Sums sums{};
        Quad const v = read(grains.velocity, i), place = read(grains.position, i) - origin, path = v + strain_rate * place;
        sums[mass_path] = v[3] * path;
        Quad outer = v[3] * gravity;
        if (has_applied) {
            Quad const force = read(grains.applied_force, i);
            sums[applied] = force * path;
            outer += force;
        }
        if (has_fluid) {
            Quad const force = read(grains.fluid_force, i), of_pressure = read(grains.pressure_force, i);
            sums[drag] = (force - of_pressure) * path;
            sums[pressure] = of_pressure * path;
            outer += force;
        }
        sums[virial] = outer * place;
        Quad power = read(grains.force, i) * v + read(grains.torque, i) * read(grains.spin, i);
        power = power * Quad{1, 1, 1, 0};
        if (grains.motion(i) != Motion::free) power -= Quad{0, 0, 0, sum_of_three(power)};
        sums[total] = power;
        return sums;
    }
};

} // namespace

GrainPower measure_grain_power(Particles const& particles, Vec3 const& gravity, PeriodicBox const& box, Vec3 const& origin,
                               SumWorkspace& sums)
{
    bool const fluid = particles.fluid_force.is_allocated() && particles.pressure_force.is_allocated();
    using Of = GrainPowerTerms;
    constexpr int count = 4 * Of::records;
    Terms<count> const t =
        reproducible_sums<count>(sums, "measure_grain_power", particles.count,
                                 Of{particles, quad_of(gravity), quad_of(origin), quad_of(box.strain_rate),
                                    particles.applied_force.is_allocated(), fluid});
    auto const axes = [&](Of::Record record) { return Vec3{t[4 * record], t[4 * record + 1], t[4 * record + 2]}; };
    auto const whole = [&](Of::Record record) { return dot(axes(record), {1, 1, 1}); };
    GrainPower power;
    power.gravity = dot(axes(Of::mass_path), gravity);
    power.applied = whole(Of::applied);
    power.drag = whole(Of::drag);
    power.pressure = whole(Of::pressure);
    power.virial = axes(Of::virial);
    power.total = whole(Of::total);
    power.held = t[4 * Of::total + 3];
    return power;
}

} // namespace arenite
