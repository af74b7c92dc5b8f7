// SPDX-License-Identifier: MIT
#include "kernels/energy_terms.hpp"

namespace arenite {
namespace {

struct GrainPowerTerms {
    Particles grains;
    Vec3 gravity, origin;
    PeriodicBox box;
    bool has_applied, has_fluid;

    KOKKOS_FUNCTION Terms<9> operator()(int i) const
    {
        Vec3 const v = vector_of(grains.velocity, i), place = vector_of(grains.position, i) - origin;
        Vec3 const weight = grains.velocity(i, 3) * gravity;
        Vec3 applied, pressure, drag;
        if (has_applied) applied = vector_of(grains.applied_force, i);
        if (has_fluid) {
            pressure = vector_of(grains.pressure_force, i);
            drag = vector_of(grains.fluid_force, i) - pressure;
        }
        Real const total = dot(vector_of(grains.force, i), v) + dot(vector_of(grains.torque, i), vector_of(grains.spin, i));
        Vec3 const path = v + box.stretch_velocity(place), outer = weight + applied + drag + pressure;
        return {{dot(weight, path), dot(applied, path), dot(drag, path), dot(pressure, path),
                 grains.motion(i) == Motion::free ? Real(0) : -total, outer.x * place.x, outer.y * place.y,
                 outer.z * place.z, total}};
    }
};

} // namespace

GrainPower measure_grain_power(Particles const& particles, Vec3 const& gravity, PeriodicBox const& box, Vec3 const& origin,
                               SumWorkspace& sums)
{
    bool const fluid = particles.fluid_force.is_allocated() && particles.pressure_force.is_allocated();
    Terms<9> const t = reproducible_sums<9>(
        sums, "measure_grain_power", particles.count,
        GrainPowerTerms{particles, gravity, origin, box, particles.applied_force.is_allocated(), fluid});
    return {t[0], t[1], t[2], t[3], t[4], {t[5], t[6], t[7]}, t[8]};
}

} // namespace arenite
