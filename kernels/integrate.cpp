// SPDX-License-Identifier: MIT
#include "kernels/integrate.hpp"

#include "core/lanes.hpp"
#include "core/turns.hpp"

namespace arenite {
namespace {

/// Grains of a turn: a host looks at the gate once a turn.
constexpr int turn_length = on_host ? 128 : 1;

/// The half of a contact's force row that is a grain's: entry 2 c + 1 has the second one, with its arm at the end.
struct RowsOfAll {
    Real const* force;

    RowsOfAll(ContactList const& list, ContactPass const&) : force(list.force.data()) {}
    KOKKOS_FORCEINLINE_FUNCTION Real const* half(int entry) const { return force + 4 * static_cast<std::ptrdiff_t>(entry); }
};

/// With those that passes share.
struct RowsOfPass : RowsOfAll {
    SharedRows entries;

    RowsOfPass(ContactList const& list, ContactPass const& pass)
        : RowsOfAll(list, pass), entries(pass.force_row.of_entries())
    {
    }
    KOKKOS_FORCEINLINE_FUNCTION Real const* half(int entry) const { return RowsOfAll::half(entries(entry)); }
};

/// What both halves of the kick need; one struct for the three kernels, so that they share every expression. A record takes
/// one instruction; its fourth number (radius, mass, moment of inertia) keeps its value, since what is added there is 0.
struct GrainStep {
    StepSettings settings;
    Real half_dt;
    Quad time, gravity, strain_rate, strain_origin;
    Real allowed_square; // m2
    Particles grains;
    ContactList contacts;
    WallForceRows walls;
    Range part; // rows of the grains
    Kokkos::View<unsigned, MemorySpace> health;
    Kokkos::View<int, MemorySpace> stale_step;
    Kokkos::View<int, PinnedSpace> notice;
    StepGate gate;
    bool has_walls, has_applied, has_fluid;

    /// Force and torque of a grain. The fourth numbers are any, but finite.
    struct Load {
        Quad force, torque;
        KOKKOS_FORCEINLINE_FUNCTION Quad square() const { return force * force + torque * torque; }
    };

    KOKKOS_FORCEINLINE_FUNCTION static Real* record(RecordView const& view, int i)
    {
        return view.data() + 4 * static_cast<std::ptrdiff_t>(i);
    }
    KOKKOS_FORCEINLINE_FUNCTION static Quad read(RecordView const& view, int i) { return load_record(record(view, i)); }
    KOKKOS_FORCEINLINE_FUNCTION static void write(Quad const& quad, RecordView const& view, int i)
    {
        store_record(quad, record(view, i));
    }

    /// Of the grain's contacts that may carry a force, in the order of their partners' ids.
    template <class Rows> KOKKOS_FORCEINLINE_FUNCTION Load gather(Rows const& rows, int i) const
    {
        Quad forces{}, torques{};
        auto const add = [&](int entry) {
            // Without a branch: rows that do not touch are zero.
            int const second = entry & 1;
            Real const* const half = rows.half(entry);
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
            prefetch(rows.half(contacts.incident(k + incident_ahead)));
            add(contacts.incident(k));
        }
        if (has_walls)
            for (int k = walls.begin(i); k < walls.begin(i + 1); ++k) {
                Real const* const row = &walls.force(walls.contact(k), 0);
                forces += load_record(row);
                torques -= row[3] * load_record(row + 4);
            }
        return {forces, torques};
    }

    /// Of everything that acts; velocity and spin as they are.
    template <class Rows>
    KOKKOS_FORCEINLINE_FUNCTION Load load(Rows const& rows, int i, Quad const& velocity, Quad const& spin) const
    {
        Load sum = gather(rows, i);
        if (has_fluid) sum.force += read(grains.fluid_force, i);
        if (has_applied) sum.force += read(grains.applied_force, i);
        sum.force += velocity[3] * gravity; // of the mass
        if (settings.local_damping > 0) {
            sum.force = sum.force - along(velocity, settings.local_damping * magnitude(sum.force));
            sum.torque = sum.torque - along(spin, settings.local_damping * magnitude(sum.torque));
        }
        return sum;
    }

    /// What half a kick adds to a record of velocity or spin.
    KOKKOS_FORCEINLINE_FUNCTION Quad half_kick(Quad const& motion, Quad const& load) const
    {
        return three_times(half_dt / motion[3]) * load;
    }

    /// not_finite: 0, or NaN to say that a force is not.
    KOKKOS_FORCEINLINE_FUNCTION void move(int i, Motion motion, Quad const& velocity, Quad const& not_finite) const
    {
        Quad position = read(grains.position, i);
        if (motion != Motion::held) {
            position += time * (velocity + strain_rate * (position - strain_origin));
            write(position, grains.position, i);
        }
        Quad const moved = position - read(contacts.reference_position, i);
        Real const square = sum_of_three(moved * moved + not_finite);
        if (square <= allowed_square) return;
        if (square < Real(1e300)) return close_gate();
        set_not_finite(); // NaN comes here
    }

    KOKKOS_FUNCTION void set_not_finite() const { Kokkos::atomic_or(&health(), static_cast<unsigned>(force_is_not_finite)); }

    KOKKOS_FUNCTION void close_gate() const
    {
        if (Kokkos::atomic_exchange(&stale_step(), gate.step) == StepGate::none) Kokkos::atomic_store(&notice(), gate.step);
    }
};

struct Kick : GrainStep {
    RowsOfAll rows;

    KOKKOS_FORCEINLINE_FUNCTION void visit(int i) const
    {
        Quad const velocity = read(grains.velocity, i), spin = read(grains.spin, i);
        Load const sum = load(rows, i, velocity, spin);
        if (!(sum_of_three(sum.square()) < Real(1e300))) set_not_finite();
        write(three_times(1) * sum.force, grains.force, i);
        write(three_times(1) * sum.torque, grains.torque, i);
        if (grains.motion(i) != Motion::free) return;
        write(velocity + half_kick(velocity, sum.force), grains.velocity, i);
        write(spin + half_kick(spin, sum.torque), grains.spin, i);
    }
};

struct Drift : GrainStep {
    KOKKOS_FORCEINLINE_FUNCTION void visit(int i) const
    {
        Quad velocity = read(grains.velocity, i);
        Motion const motion = grains.motion(i);
        if (motion == Motion::free) {
            Quad const spin = read(grains.spin, i);
            velocity += half_kick(velocity, read(grains.force, i));
            write(velocity, grains.velocity, i);
            write(spin + half_kick(spin, read(grains.torque, i)), grains.spin, i);
        }
        move(i, motion, velocity, Quad{});
    }
};

template <class Rows> struct KickAndDrift : GrainStep {
    Rows rows;

    KOKKOS_FORCEINLINE_FUNCTION void visit(int i) const
    {
        Quad velocity = read(grains.velocity, i);
        Quad const spin = read(grains.spin, i);
        Load const sum = load(rows, i, velocity, spin);
        Motion const motion = grains.motion(i);
        if (motion == Motion::free) {
            Quad const kick = half_kick(velocity, sum.force), turn = half_kick(spin, sum.torque);
            velocity = velocity + kick + kick;
            write(velocity, grains.velocity, i);
            write(spin + turn + turn, grains.spin, i);
        }
        move(i, motion, velocity, Real(0) * sum.square()); // one comparison for both
    }
};

template <class Step> struct Turns {
    Step step;

    KOKKOS_FUNCTION void operator()(int turn) const
    {
        if (step.gate.closed()) return;
        int const begin = step.part.begin + turn * turn_length, end = Kokkos::min(begin + turn_length, step.part.end);
        for (int i = begin; i < end; ++i) step.visit(i);
    }
};

template <class Step> void launch(char const* name, Step const& step)
{
    int const turns = (step.part.end - step.part.begin + turn_length - 1) / turn_length;
    for_each_turn(name, turns, Turns<Step>{step});
}

GrainStep make_step(Integrator const& integrator, StepSettings const& settings, Particles const& particles,
                    ContactList const& contacts, WallForceRows const& walls, ContactPass const& pass)
{
    return {settings,
            Real(0.5) * settings.dt,
            three_times(settings.dt),
            quad_of(settings.gravity),
            quad_of(settings.strain_rate),
            quad_of(settings.strain_origin),
            settings.allowed_move * settings.allowed_move,
            particles,
            contacts,
            walls,
            pass.grains,
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
    ContactPass const all = whole_step(contacts);
    launch("kick", Kick{make_step(integrator, settings, particles, contacts, walls, all), RowsOfAll(contacts, all)});
}

void drift(Integrator& integrator, StepSettings const& settings, Particles const& particles, ContactList const& contacts)
{
    launch("drift", Drift{make_step(integrator, settings, particles, contacts, {}, whole_step(contacts))});
    ++integrator.step;
}

void kick_and_drift(Integrator& integrator, StepSettings const& settings, Particles const& particles,
                    ContactList const& contacts, WallForceRows const& walls, ContactPass const& pass)
{
    auto const launch_with = [&]<class Rows>() {
        launch("kick_and_drift",
               KickAndDrift<Rows>{make_step(integrator, settings, particles, contacts, walls, pass), Rows(contacts, pass)});
    };
    if (pass.force_row.count == 0) launch_with.template operator()<RowsOfAll>();
    else if constexpr (on_host) launch_with.template operator()<RowsOfPass>();
    if (pass.last) ++integrator.step;
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
    ExecutionSpace().fence("steps that were launched"); // then the notice says all
    int const stale = integrator.notice();
    int const launched = integrator.step;
    integrator.step = 0;
    if (stale == StepGate::none) return -1;
    Kokkos::deep_copy(integrator.stale_step, StepGate::none);
    Kokkos::deep_copy(integrator.notice, StepGate::none);
    return launched - 1 - stale;
}

} // namespace arenite
