// SPDX-License-Identifier: MIT
#include "kernels/integrate.hpp"

#include "core/lanes.hpp"

namespace arenite {
namespace {

/// What both halves of the kick need; one struct for the three kernels, so that they share every expression. A kernel takes
/// lane_count grains at a time.
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

    using Numbers = Vector<Lanes>;

    /// Force and torque of the grains in the lanes.
    struct Load {
        Numbers force, torque;
    };

    /// The grains of a block. Beyond the last one it names the last again: that lane computes and stores the same.
    struct Rows {
        int row[lane_count];

        KOKKOS_FORCEINLINE_FUNCTION Rows(int block, int count)
        {
            for (int n = 0; n < lane_count; ++n)
                row[n] = block * lane_count + n < count ? block * lane_count + n : count - 1;
        }
    };

    KOKKOS_FORCEINLINE_FUNCTION static LaneRecords read(RecordView const& view, Rows const& rows)
    {
        return load_records(view.data(), rows.row);
    }
    KOKKOS_FORCEINLINE_FUNCTION static void write(LaneRecords const& records, RecordView const& view, Rows const& rows)
    {
        store_records(records, view.data(), rows.row);
    }

    /// The half of a contact's row that is the grain's: entry 2 c + 1 has the second one, with its arm at the end.
    KOKKOS_FORCEINLINE_FUNCTION Real const* half_row(int entry) const
    {
        return contacts.force.data() + 4 * static_cast<std::ptrdiff_t>(entry);
    }

    /// Of the grain's contacts that may carry a force, in the order of their partners' ids.
    KOKKOS_FORCEINLINE_FUNCTION void gather(int i, Quad& force, Quad& torque) const
    {
        Quad forces{}, torques{}; // in registers until the grain is done; their fourth number is no force
        auto const add = [&](int entry) {
            // Without a branch: rows that do not touch are zero.
            int const second = entry & 1;
            Real const* const half = half_row(entry);
            Real const* const row = half - 4 * second;
            forces += negated_if(second, load_record(row));
            torques -= half[3] * load_record(row + 4); // (-arm n) x F on both sides
        };
        int const begin = contacts.incident_begin(i), end = contacts.incident_begin(i + 1);
        int k = begin;
        if (contacts.awake(i)) { // the others lie between the close ones
            int const row = contacts.grains() + i, last = contacts.incident_begin(row + 1);
            int const first_place = contacts.incident_begin(contacts.grains());
            for (int other = contacts.incident_begin(row); other < last; ++other) {
                int const until = begin + contacts.incident_place(other - first_place);
                for (; k < until; ++k) add(contacts.incident(k));
                add(contacts.incident(other));
            }
        }
        for (; k < end; ++k) {
            prefetch(half_row(contacts.incident(k + incident_ahead)));
            add(contacts.incident(k));
        }
        if (has_walls)
            for (int k = walls.begin(i); k < walls.begin(i + 1); ++k) {
                Real const* const row = &walls.force(walls.contact(k), 0);
                forces += load_record(row);
                torques -= row[3] * load_record(row + 4);
            }
        force = forces;
        torque = torques;
    }

    KOKKOS_FORCEINLINE_FUNCTION Numbers damped(Numbers const& force, Numbers const& velocity) const
    {
        Numbers result;
        for (int axis = 0; axis < 3; ++axis) {
            Lanes const damping = settings.local_damping * magnitude(force[axis]);
            result[axis] = force[axis] -
                           select(velocity[axis] > Lanes(0), damping, select(velocity[axis] < Lanes(0), -damping, Lanes(0)));
        }
        return result;
    }

    /// Of everything that acts; velocity and spin as they are.
    KOKKOS_FORCEINLINE_FUNCTION Load load(Rows const& rows, LaneRecords const& velocity, LaneRecords const& spin) const
    {
        Quad forces[lane_count], torques[lane_count];
        for (int n = 0; n < lane_count; ++n) gather(rows.row[n], forces[n], torques[n]);
        Load sum{lanes_of(forces).xyz, lanes_of(torques).xyz};
        if (has_fluid) sum.force += read(grains.fluid_force, rows).xyz;
        if (has_applied) sum.force += read(grains.applied_force, rows).xyz;
        for (int axis = 0; axis < 3; ++axis) sum.force[axis] += velocity.w * settings.gravity[axis];
        if (settings.local_damping > 0) {
            sum.force = damped(sum.force, velocity.xyz);
            sum.torque = damped(sum.torque, spin.xyz);
        }
        // One comparison is false for NaN and for infinity.
        if (!all(dot(sum.force, sum.force) + dot(sum.torque, sum.torque) < Lanes(1e300)))
            Kokkos::atomic_or(&health(), static_cast<unsigned>(force_is_not_finite));
        return sum;
    }

    /// Lanes whose grain's motion is not `motion`.
    KOKKOS_FORCEINLINE_FUNCTION LaneMask unlike(Rows const& rows, Motion motion) const
    {
        int others = 0;
        for (int n = 0; n < lane_count; ++n) others += grains.motion(rows.row[n]) != motion;
        if (others == lane_count) return LaneMask(true);
        if (others == 0) return LaneMask(false);
        return make_lanes([&](int n) { return Real(grains.motion(rows.row[n]) != motion); }) > Lanes(0);
    }

    KOKKOS_FORCEINLINE_FUNCTION void push(LaneMask const& driven, Load const& load, LaneRecords& velocity,
                                          LaneRecords& spin) const
    {
        velocity.xyz = select(driven, velocity.xyz, velocity.xyz + (half_dt / velocity.w) * load.force);
        spin.xyz = select(driven, spin.xyz, spin.xyz + (half_dt / spin.w) * load.torque);
    }

    KOKKOS_FORCEINLINE_FUNCTION void move(Rows const& rows, Numbers const& velocity) const
    {
        LaneMask const moves = unlike(rows, Motion::held);
        LaneRecords position = read(grains.position, rows);
        Numbers speed = velocity;
        for (int axis = 0; axis < 3; ++axis)
            speed[axis] += settings.strain_rate[axis] * (position.xyz[axis] - settings.box_lower[axis]);
        position.xyz = select(moves, position.xyz + settings.dt * speed, position.xyz);
        write(position, grains.position, rows);
        Numbers const moved = position.xyz - read(contacts.reference_position, rows).xyz;
        Lanes const square = dot(moved, moved);
        LaneMask const near = square <= Lanes(settings.allowed_move * settings.allowed_move);
        if (all(near || !moves)) return;
        LaneMask const somewhere = square < Lanes(1e300);
        if (any(moves && !near && somewhere)) close_gate();
        if (any(moves && !somewhere))
            Kokkos::atomic_or(&health(), static_cast<unsigned>(force_is_not_finite)); // NaN comes here
    }

    KOKKOS_FUNCTION void close_gate() const
    {
        if (Kokkos::atomic_exchange(&stale_step(), gate.step) == StepGate::none) Kokkos::atomic_store(&notice(), gate.step);
    }
};

struct Kick : GrainStep {
    KOKKOS_FUNCTION void operator()(int block) const
    {
        if (gate.closed()) return;
        Rows const rows(block, grains.count);
        LaneRecords velocity = read(grains.velocity, rows), spin = read(grains.spin, rows);
        Load const sum = load(rows, velocity, spin);
        write({sum.force, Lanes(0)}, grains.force, rows);
        write({sum.torque, Lanes(0)}, grains.torque, rows);
        push(unlike(rows, Motion::free), sum, velocity, spin);
        write(velocity, grains.velocity, rows);
        write(spin, grains.spin, rows);
    }
};

struct Drift : GrainStep {
    KOKKOS_FUNCTION void operator()(int block) const
    {
        if (gate.closed()) return;
        Rows const rows(block, grains.count);
        LaneRecords velocity = read(grains.velocity, rows), spin = read(grains.spin, rows);
        push(unlike(rows, Motion::free), {read(grains.force, rows).xyz, read(grains.torque, rows).xyz}, velocity, spin);
        write(velocity, grains.velocity, rows);
        write(spin, grains.spin, rows);
        move(rows, velocity.xyz);
    }
};

struct KickAndDrift : GrainStep {
    KOKKOS_FUNCTION void operator()(int block) const
    {
        if (gate.closed()) return;
        Rows const rows(block, grains.count);
        LaneRecords velocity = read(grains.velocity, rows), spin = read(grains.spin, rows);
        Load const sum = load(rows, velocity, spin);
        LaneMask const driven = unlike(rows, Motion::free);
        for (int half = 0; half < 2; ++half) push(driven, sum, velocity, spin);
        write(velocity, grains.velocity, rows);
        write(spin, grains.spin, rows);
        move(rows, velocity.xyz);
    }
};

RangePolicy blocks_of(Particles const& particles) { return {0, (particles.count + lane_count - 1) / lane_count}; }

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
    Kokkos::parallel_for("kick", blocks_of(particles), Kick{make_step(integrator, settings, particles, contacts, walls)});
}

void drift(Integrator& integrator, StepSettings const& settings, Particles const& particles, ContactList const& contacts)
{
    Kokkos::parallel_for("drift", blocks_of(particles), Drift{make_step(integrator, settings, particles, contacts, {})});
    ++integrator.step;
}

void kick_and_drift(Integrator& integrator, StepSettings const& settings, Particles const& particles,
                    ContactList const& contacts, WallForceRows const& walls)
{
    Kokkos::parallel_for("kick_and_drift", blocks_of(particles),
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
