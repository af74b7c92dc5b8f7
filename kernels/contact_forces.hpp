// SPDX-License-Identifier: MIT
// Forces between grains: each pair is evaluated once, under a law that was chosen outside the step.
//
// Traffic of a touching pair (JKR with history): 192 B of grains (mostly from cache), 32 B scale, 2 x 32 B
// spring, 64 B force, 10 B of indices and flags; a pair that is only near reads 2 positions and 2 flags.
#pragma once

#include "core/contact_list.hpp"
#include "core/particles.hpp"
#include "kernels/contact/contact_law.hpp"

namespace arenite {

/// What a contact asks of the box; chosen per stage, so that a closed box costs nothing.
enum class BoxKind { closed, periodic, deforming };

/// One contact, as the kernel below runs it. A struct and not a lambda, so that the law's compile-time
/// choices can use `if constexpr` under nvcc.
template <class Law, BoxKind kind> struct ContactEvaluation {
    Law law;
    ContactList list;
    RecordView position, velocity, spin;
    View1<std::uint8_t> material;
    PeriodicBox box;
    Real dt;

    KOKKOS_FUNCTION void operator()(int c) const
    {
        int const i = list.first(c), j = list.second(c);
        Vec3 offset = vector_of(position, i) - vector_of(position, j);
        if constexpr (kind != BoxKind::closed)
            if (list.periodic) offset -= box.image_shift(list.image(c));
        Real const ri = position(i, 3), rj = position(j, 3);
        Real const square = dot(offset, offset);
        bool adhering = false;
        if constexpr (Law::adheres) adhering = list.adhering(c);
        if (square >= (ri + rj) * (ri + rj) && !adhering) {
            if (list.touching(c)) clear(c);
            return;
        }
        evaluate(c, i, j, offset, Kokkos::sqrt(square));
    }

    KOKKOS_FUNCTION void clear(int c) const
    {
        list.touching(c) = 0;
        if constexpr (Law::has_history)
            for (int n = 0; n < 4; ++n) list.spring(c, n) = 0;
    }

    KOKKOS_FUNCTION void evaluate(int c, int i, int j, Vec3 const& offset, Real distance) const
    {
        Real const ri = position(i, 3), rj = position(j, 3);
        ContactGeometry contact;
        // Concentric grains have no line of centres: they part along z.
        Real const inverse = distance > 0 ? 1 / distance : 0;
        contact.normal = distance > 0 ? inverse * offset : Vec3{0, 0, 1};
        contact.overlap = ri + rj - distance;
        // Arms to the plane of contact; they add up to the distance. A grain wholly inside another has no such
        // plane: its arm stays its radius.
        Real const sum = ri + rj;
        Real const lead = Kokkos::fmin(Kokkos::fmax((ri - rj) * sum * inverse, -sum), sum);
        Real const arm_i = Real(0.5) * (distance + lead), arm_j = Real(0.5) * (distance - lead);
        Vec3 approach = vector_of(velocity, i) - vector_of(velocity, j);
        // The grains of a deforming box ride on its homogeneous flow, which their velocities do not hold.
        if constexpr (kind == BoxKind::deforming) approach += box.stretch_velocity(offset);
        contact.velocity = approach;
        contact.scale = {list.scale(c, 0), list.scale(c, 1), list.scale(c, 2)};

        ContactState state;
        if constexpr (Law::adheres) state.adhering = list.adhering(c);
        if constexpr (Law::has_history) {
            Vec3 const spring = vector_of(list.spring, c);
            state.previous_radius = list.spring(c, 3);
            // The grains came here along straight lines: the last offset is known exactly.
            Vec3 previous = normalized_near(offset - dt * approach, inverse);
            // Centres that passed each other within the step have no turn to follow.
            if (!(dot(previous, contact.normal) > 0)) previous = contact.normal;
            Vec3 const spin_i = step_spin(vector_of(spin, i), dt), spin_j = step_spin(vector_of(spin, j), dt);
            ContactTurn const turn = contact_turn(previous, contact.normal);
            contact.velocity = surface_velocity(approach, arm_i * spin_i + arm_j * spin_j, turn, contact.normal);
            Real const twist = Real(0.25) * dt * dot(spin_i + spin_j, turn.sum);
            state.spring = transport_spring(spring, turn, contact.normal, twist);
        }
        Vec3 const force = law(contact, law.pairs(material(i), material(j)), state, dt);
        store(c, contact, state, force, arm_i, arm_j);
    }

    KOKKOS_FUNCTION void store(int c, ContactGeometry const& contact, ContactState const& state, Vec3 const& force,
                               Real arm_i, Real arm_j) const
    {
        list.touching(c) = state.touching;
        if constexpr (Law::adheres) list.adhering(c) = state.adhering;
        if constexpr (Law::has_history) {
            set_vector(list.spring, c, state.spring);
            list.spring(c, 3) = state.previous_radius;
        }
        Vec3 const moment = cross(contact.normal, force);
        list.force(c, 0) = force.x;
        list.force(c, 1) = force.y;
        list.force(c, 2) = force.z;
        list.force(c, 3) = arm_i;
        list.force(c, 4) = moment.x;
        list.force(c, 5) = moment.y;
        list.force(c, 6) = moment.z;
        list.force(c, 7) = arm_j;
    }
};

template <class Law>
void evaluate_contacts(Law const& law, Particles const& particles, PeriodicBox const& box, ContactList const& contacts,
                       Real dt)
{
    auto const launch = [&](auto evaluation) {
        Kokkos::parallel_for("evaluate_contacts", RangePolicy(0, contacts.count), evaluation);
    };
    auto const make = [&]<BoxKind kind>() {
        return ContactEvaluation<Law, kind>{law, contacts, particles.position, particles.velocity, particles.spin,
                                            particles.material, box, dt};
    };
    if (box.deforms()) launch(make.template operator()<BoxKind::deforming>());
    else if (contacts.periodic) launch(make.template operator()<BoxKind::periodic>());
    else launch(make.template operator()<BoxKind::closed>());
}

} // namespace arenite
