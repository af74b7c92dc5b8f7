// SPDX-License-Identifier: MIT
// The kernel of the forces between grains: each pair is evaluated once, under a law that was chosen outside the step,
// lane_count pairs at a time. What launches it is in kernels/evaluate_forces.hpp; one source compiles it for all laws.
//
// Traffic of a touching pair (JKR with history): 192 B of grains (mostly from cache), 24 B scale, 2 x 24 B
// spring, 64 B force, 10 B of indices and flags. A block of pairs that are only near reads 2 positions and 2 flags a pair.
#pragma once

#include "core/particles.hpp"
#include "core/turns.hpp"
#include "kernels/contact/contact_law.hpp"
#include "kernels/contact_lanes.hpp"
#include "kernels/step_gate.hpp"

namespace arenite {

/// What a contact asks of the box; chosen per stage, so that a closed box costs nothing.
enum class BoxKind { closed, periodic, deforming };

/// lane_count contacts, as the kernel below runs them. A struct and not a lambda, so that the law's compile-time
/// choices can use `if constexpr` under nvcc. several: there are pairs of different materials. pass: the contacts' part.
template <class Law, BoxKind kind, bool several> struct ContactEvaluation {
    Law law;
    ContactList list;
    RecordView position, velocity, spin;
    View1<std::uint8_t> material;
    PeriodicBox box;
    Real dt;
    StepGate gate = {};
    ContactPass pass = whole_step(list);
    BlockTurns turns{pass};

    using Numbers = Vector<Lanes>;

    KOKKOS_FORCEINLINE_FUNCTION void operator()(int k) const
    {
        if (gate.closed()) return;
        Range const blocks = turns(k);
        for (int block = blocks.begin; block < blocks.end; ++block) visit(block * lane_count);
    }

    /// Contacts c .. c + lane_count - 1.
    KOKKOS_FORCEINLINE_FUNCTION void visit(int c) const
    {
        int const *const i = &list.first(c), *const j = &list.second(c);
        ask_for_later(j, position, velocity, spin);
        LaneRecords const between = load_differences(position.data(), i, j, 1); // and the sum of the radii
        Numbers offset = between.xyz;
        if constexpr (kind != BoxKind::closed)
            if (list.periodic) offset -= image_shifts(list, box, c);
        Lanes const square = dot(offset, offset), reach = between.w;
        LaneMask active = square < reach * reach;
        ContactState<Lanes> state;
        if constexpr (Law::adheres) {
            state.adhering = load_flags(&list.adhering(c));
            active = active || state.adhering;
        }
        if (!any(active)) return clear(c);
        evaluate(c, i, j, offset, square, reach, state);
    }

    KOKKOS_FORCEINLINE_FUNCTION void clear(int c) const
    {
        if (any(load_flags(&list.touching(c)))) {
            store_flags(LaneMask(false), &list.touching(c));
            if constexpr (Law::has_history)
                for (int k = 0; k < 3; ++k) store_lanes(Lanes(0), &list.spring(c, k));
            if (list.needs.contact_radius) store_lanes(Lanes(0), &list.contact_radius(c));
        } else if (!list.rows_may_be_old(c)) return;
        Real* const rows = force_rows(c);
        for (int k = 0; k < 8 * lane_count; ++k) rows[k] = 0;
    }

    KOKKOS_FORCEINLINE_FUNCTION Real* force_rows(int c) const
    {
        int const row = on_host ? pass.force_row(c) : c;
        return list.force.data() + 8 * static_cast<std::ptrdiff_t>(row);
    }

    /// offset: from the second centres to the first, with its square; reach: the sums of the radii.
    KOKKOS_FORCEINLINE_FUNCTION void evaluate(int c, int const* i, int const* j, Numbers const& offset,
                                              Lanes const& offset_square, Lanes const& reach,
                                              ContactState<Lanes>& state) const
    {
        // Concentric grains have no line of centres: they part along z.
        Numbers line = offset;
        line.z = select(offset_square > Lanes(0), offset.z, Lanes(1e-30));
        Lanes const square = larger(offset_square, Lanes(1e-60)), distance = square_root(square),
                    inverse_square = 1 / square, inverse = inverse_square * distance;
        ContactGeometry<Lanes> contact;
        // What the first grain's arm to the plane of contact is of the distance; the arms add up to that. A grain wholly
        // inside another (the first, which is the smaller) has no such plane: its arm stays its radius.
        Lanes const half_difference = Real(0.5) * reach - records_of(position, j).w; // of the radii
        Lanes const share_i = Real(0.5) + reach * larger(half_difference * inverse_square, Real(-0.5) * inverse);
        Numbers approach = load_differences(velocity.data(), i, j, -1).xyz;
        // The grains of a deforming box ride on its homogeneous flow, which their velocities do not hold.
        if constexpr (kind == BoxKind::deforming) approach += box.stretch_velocity(offset);
        contact.scale = load_scale<Law::adheres>(list, c);

        if constexpr (Law::has_history) {
            Numbers const spring{load_lanes(&list.spring(c, 0)), load_lanes(&list.spring(c, 1)),
                                 load_lanes(&list.spring(c, 2))};
            if (list.needs.contact_radius) state.previous_radius = load_lanes(&list.contact_radius(c));
            StraightTurn<Lanes> const step = straight_turn(line, inverse_square, approach, dt);
            Numbers const spin_i = records_of(spin, i).xyz, spin_j = records_of(spin, j).xyz, spin_sum = spin_i + spin_j;
            Lanes const counted = step.twice_cosine * (Real(0.5) * cayley_factor(spin_sum, dt));
            contact.motion = {step.parting * inverse, slip_over(step, share_i * spin_i + (1 - share_i) * spin_j, counted)};
            state.spring = transport_spring(spring, step.turn, Real(0.5) * dt * counted * dot(spin_sum, step.turn.mean));
        } else {
            contact.motion = surface_motion(approach, inverse * line);
        }
        contact.normal = inverse * line; // not earlier: the motion takes all registers that there are
        contact.overlap = reach - distance;
        Lanes const arm_i = share_i * distance, arm_j = distance - arm_i;
        store(c, contact, force_of(contact, i, j, state), state, arm_i, arm_j);
    }

    /// From now on the grains of the others that touch here gather all their contacts. Whoever writes, writes the same.
    KOKKOS_FORCEINLINE_FUNCTION void wake_grains(int c) const
    {
        for (int n = c; n < c + lane_count; ++n)
            if (n >= list.close && list.touching(n)) list.awake(list.first(n)) = list.awake(list.second(n)) = 1;
    }

    KOKKOS_FORCEINLINE_FUNCTION Numbers force_of(ContactGeometry<Lanes> const& contact, int const* i, int const* j,
                                                 ContactState<Lanes>& state) const
    {
        if constexpr (!several) return law(contact, law.pairs(law.pairs.shared), state, dt);
        Numbers force;
        ContactState<Lanes> const before = state;
        for_each_material_pair(law.pairs, material, i, j, [&](PairConstants const& pair, LaneMask const& same) {
            ContactState<Lanes> after = before;
            force = select(same, law(contact, pair, after, dt), force);
            state = select(same, after, state);
        });
        return force;
    }

    KOKKOS_FORCEINLINE_FUNCTION void store(int c, ContactGeometry<Lanes> const& contact, Numbers const& force,
                                           ContactState<Lanes> const& state, Lanes const& arm_i, Lanes const& arm_j) const
    {
        store_flags(state.touching, &list.touching(c));
        if (c + lane_count > list.close) wake_grains(c);
        if constexpr (Law::adheres) store_flags(state.adhering, &list.adhering(c));
        if constexpr (Law::has_history) {
            for (int axis = 0; axis < 3; ++axis) store_lanes(state.spring[axis], &list.spring(c, axis));
            if (list.needs.contact_radius) store_lanes(state.previous_radius, &list.contact_radius(c));
        }
        Numbers const moment = cross(contact.normal, force);
        Real* const rows = force_rows(c);
        store_records({force, arm_i}, rows, 8);
        store_records({moment, arm_j}, rows + 4, 8);
    }
};

} // namespace arenite
