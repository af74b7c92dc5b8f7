// SPDX-License-Identifier: MIT
#include "kernels/energy_terms.hpp"

namespace arenite {
namespace {

/// In each record the shares of three axes.
struct GrainPowerRecords {
    Quad gravity{}, applied{}, drag{}, pressure{}, virial{}, total{};
    Real held = 0;

    KOKKOS_FORCEINLINE_FUNCTION GrainPowerRecords& operator+=(GrainPowerRecords const& more)
    {
        gravity += more.gravity, applied += more.applied, drag += more.drag, pressure += more.pressure;
        virial += more.virial, total += more.total, held += more.held;
        return *this;
    }
    KOKKOS_FORCEINLINE_FUNCTION Terms<9> numbers() const
    {
        return {{sum_of_three(gravity), sum_of_three(applied), sum_of_three(drag), sum_of_three(pressure), held, virial[0],
                 virial[1], virial[2], sum_of_three(total)}};
    }
};

struct GrainPowerTerms {
    Particles grains;
    Quad gravity, origin, strain_rate;
    bool has_applied, has_fluid;

    KOKKOS_FORCEINLINE_FUNCTION static Quad read(RecordView const& view, int i)
    {
        return load_record(view.data() + 4 * static_cast<std::ptrdiff_t>(i));
    }

    KOKKOS_FORCEINLINE_FUNCTION GrainPowerRecords operator()(int i) const
    {
        GrainPowerRecords power;
        Quad const v = read(grains.velocity, i), place = read(grains.position, i) - origin, path = v + strain_rate * place;
        Quad outer = v[3] * gravity;
        power.gravity = outer * path;
        if (has_applied) {
            Quad const force = read(grains.applied_force, i);
            power.applied = force * path;
            outer += force;
        }
        if (has_fluid) {
            Quad const force = read(grains.fluid_force, i), of_pressure = read(grains.pressure_force, i);
            power.drag = (force - of_pressure) * path;
            power.pressure = of_pressure * path;
            outer += force;
        }
        power.virial = outer * place;
        power.total = read(grains.force, i) * v + read(grains.torque, i) * read(grains.spin, i);
        if (grains.motion(i) != Motion::free) power.held = -sum_of_three(power.total);
        return power;
    }
};

} // namespace

void sum_grain_power(Real* to, Particles const& particles, Vec3 const& gravity, PeriodicBox const& box, Vec3 const& origin,
                     SumWorkspace& sums)
{
    bool const fluid = particles.fluid_force.is_allocated() && particles.pressure_force.is_allocated();
    reproducible_sums_to<grain_power_terms>(to, sums, "grain_power", particles.count,
                                            GrainPowerTerms{particles, quad_of(gravity), quad_of(origin),
                                                            quad_of(box.strain_rate), particles.applied_force.is_allocated(),
                                                            fluid});
}

} // namespace arenite
