// SPDX-License-Identifier: MIT
#include "kernels/integrate.hpp"

#include "core/lanes.hpp"

namespace arenite {
namespace {

/// What both halves of the kick need; one struct for the three kernels, so that they share every expression.
struct GrainStep {
    StepSettings settings;
    Real half_dt;
    Particles grains;
    ContactList contacts;
    WallForceRows walls;
    Kokkos::View<unsigned, MemorySpace> health;
    Kokkos::View<int, MemorySpace> stale_step;
    Kokkos::View<int, PinnedSpace> notice;
    StepGate gate;
    bool has_walls, has_applied, has_fluid;

    KOKKOS_FUNCTION Real const* row_of(int entry) const { return contacts.force.data() + 8 * static_cast<std::ptrdiff_t>(entry >> 1); }

    KOKKOS_FUNCTION void gather(int i, Vec3& force, Vec3& torque) const
    {
        Quad forces{}, torques{}; // their fourth number is no force
        for (int k = contacts.incident_begin(i); k < contacts.incident_begin(i + 1); ++k) {
            prefetch(row_of(contacts.incident(k + incident_ahead)));
            // Without a branch: rows that do not touch are zero.
            int const entry = contacts.incident(k), second = entry & 1;
            Real const* const row = row_of(entry);
            forces += Real(1 - 2 * second) * load_quad(row);
            torques -= row[3 + 4 * second] * load_quad(row + 4); // (-arm n) x F on both sides
        }
        if (has_walls)
            for (int k = walls.begin(i); k < walls.begin(i + 1); ++k) {
                Real const* const row = &walls.force(walls.contact(k), 0);
                forces += load_quad(row);
                torques -= row[3] * load_quad(row + 4);
            }
        force = xyz_of(forces);
        torque = xyz_of(torques);
    }

    KOKKOS_FUNCTION Vec3 damped(Vec3 const& force, Vec3 const& velocity) const
    {
        Vec3 result;
        for (int axis = 0; axis < 3; ++axis) {
            Real const sign = Real(velocity[axis] > 0) - Real(velocity[axis] < 0); // no branch: signs are anybody's guess
            result[axis] = force[axis] - settings.local_damping * Kokkos::fabs(force[axis]) * sign;
        }
        return result;
    }

    /// Force and torque at the grain's position.
    KOKKOS_FUNCTION void total(int i, Vec3& force, Vec3& torque) const
    {
        gather(i, force, torque);
        if (has_fluid) force += vector_of(grains.fluid_force, i);
        if (has_applied) force += vector_of(grains.applied_force, i);
        force += grains.velocity(i, 3) * settings.gravity;
        if (settings.local_damping > 0) {
            force = damped(force, vector_of(grains.velocity, i));
            torque = damped(torque, vector_of(grains.spin, i));
        }
        // One comparison is false for NaN and for infinity.
        if (!(dot(force, force) + dot(torque, torque) < Real(1e300)))
            Kokkos::atomic_or(&health(), static_cast<unsigned>(force_is_not_finite));
    }

    KOKKOS_FUNCTION void push(int i, Vec3 const& force, Vec3 const& torque) const
    {
        if (grains.motion(i) != Motion::free) return;
        set_vector(grains.velocity, i, vector_of(grains.velocity, i) + (half_dt / grains.velocity(i, 3)) * force);
        set_vector(grains.spin, i, vector_of(grains.spin, i) + (half_dt / grains.spin(i, 3)) * torque);
    }

    KOKKOS_FUNCTION void move(int i) const
    {
        if (grains.motion(i) == Motion::held) return;
        Vec3 const here = vector_of(grains.position, i);
        Vec3 const stretch{settings.strain_rate.x * (here.x - settings.box_lower.x),
                           settings.strain_rate.y * (here.y - settings.box_lower.y),
                           settings.strain_rate.z * (here.z - settings.box_lower.z)};
        Vec3 const there = here + settings.dt * (vector_of(grains.velocity, i) + stretch);
        set_vector(grains.position, i, there);
        Vec3 const moved = there - vector_of(contacts.reference_position, i);
        Real const square = dot(moved, moved);
        if (square <= settings.allowed_move * settings.allowed_move) return;
        if (square < Real(1e300)) close_gate();
        else Kokkos::atomic_or(&health(), static_cast<unsigned>(force_is_not_finite)); // NaN comes here
    }

    KOKKOS_FUNCTION void close_gate() const
    {
        if (Kokkos::atomic_exchange(&stale_step(), gate.step) == StepGate::none) Kokkos::atomic_store(&notice(), gate.step);
    }
};

struct Kick : GrainStep {
    KOKKOS_FUNCTION void operator()(int i) const
    {
        if (gate.closed()) return;
        Vec3 force, torque;
        total(i, force, torque);
        set_vector(grains.force, i, force);
        set_vector(grains.torque, i, torque);
        push(i, force, torque);
    }
};

struct Drift : GrainStep {
    KOKKOS_FUNCTION void operator()(int i) const
    {
        if (gate.closed()) return;
        push(i, vector_of(grains.force, i), vector_of(grains.torque, i));
        move(i);
    }
};

struct KickAndDrift : GrainStep {
    KOKKOS_FUNCTION void operator()(int i) const
    {
        if (gate.closed()) return;
        Vec3 force, torque;
        total(i, force, torque);
        push(i, force, torque);
        push(i, force, torque);
        move(i);
    }
};

GrainStep make_step(Integrator const& integrator, StepSettings const& settings, Particles const& particles,
                    ContactList const& contacts, WallForceRows const& walls)
{
    return {settings,
            Real(0.5) * settings.dt,
            particles,
            contacts,
            walls,
            integrator.health,
            integrator.stale_step,
            integrator.notice,
            integrator.gate(),
            walls.begin.extent(0) > 0,
            particles.applied_force.is_allocated(),
            particles.fluid_force.is_allocated()};
}

} // namespace

Integrator::Integrator() : health("health"), stale_step(uninitialized("stale_step")), notice(uninitialized("stale_notice"))
{
    Kokkos::deep_copy(stale_step, StepGate::none);
    Kokkos::deep_copy(notice, StepGate::none);
}

void kick(Integrator const& integrator, StepSettings const& settings, Particles const& particles,
          ContactList const& contacts, WallForceRows const& walls)
{
    Kokkos::parallel_for("kick", RangePolicy(0, particles.count),
                         Kick{make_step(integrator, settings, particles, contacts, walls)});
}

void drift(Integrator& integrator, StepSettings const& settings, Particles const& particles,
           ContactList const& contacts)
{
    Kokkos::parallel_for("drift", RangePolicy(0, particles.count),
                         Drift{make_step(integrator, settings, particles, contacts, {})});
    ++integrator.step;
}

void kick_and_drift(Integrator& integrator, StepSettings const& settings, Particles const& particles,
                    ContactList const& contacts, WallForceRows const& walls)
{
    Kokkos::parallel_for("kick_and_drift", RangePolicy(0, particles.count),
                         KickAndDrift{make_step(integrator, settings, particles, contacts, walls)});
    ++integrator.step;
}

unsigned read_health(Integrator const& integrator)
{
    unsigned bits = 0;
    Kokkos::deep_copy(bits, integrator.health);
    return bits;
}

bool says_stale(Integrator const& integrator)
{
    if (integrator.step % integrator.look_interval != 0) return false;
    return *static_cast<int const volatile*>(integrator.notice.data()) != StepGate::none;
}

int take_stale(Integrator& integrator)
{
    int stale = StepGate::none;
    Kokkos::deep_copy(stale, integrator.stale_step);
    int const launched = integrator.step;
    integrator.step = 0;
    if (stale == StepGate::none) return -1;
    Kokkos::deep_copy(integrator.stale_step, StepGate::none);
    Kokkos::deep_copy(integrator.notice, StepGate::none);
    return launched - 1 - stale;
}

} // namespace arenite
