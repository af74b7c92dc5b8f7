// SPDX-License-Identifier: MIT
// The kernel of the forces of walls on grains, under a contact law chosen outside the step. A wall is a body of infinite
// radius and mass: R* = R_i, m* = m_i, and the arm reaches from the grain's centre to the wall's nearest point.
#pragma once

#include "core/turns.hpp"
#include "kernels/contact/contact_law.hpp"
#include "kernels/contact_lanes.hpp"
#include "kernels/step_gate.hpp"
#include "kernels/wall_contacts.hpp"

namespace arenite {

/// The rows in the lanes.
struct WallContactLanes {
    int row[lane_count], grain[lane_count], pair[lane_count]; // pair: of materials
};

/// Their walls as the law needs them.
struct WallSurface {
    Vector<Lanes> normal;         // unit, towards the grain
    Lanes distance;               // m, of the grain's centre
    Vector<Lanes> velocity, spin; // at the contact, m/s, less that of the flow that the grain rides on; rad/s
};

/// Rows that go on touching a wall that is not flat, until there are lane_count of them.
struct WallContactBatch : WallContactLanes {
    int count = 0;
    Real normal[3][lane_count], distance[lane_count];
    Real wall_velocity[3][lane_count], wall_spin[3][lane_count]; // at the contact, m/s; rad/s

    /// flow [m/s]: that the grain rides on.
    KOKKOS_FUNCTION void add(int c, int i, int materials, WallProximity const& p, WallPose const& pose, Vec3 const& x,
                             Vec3 const& flow)
    {
        int const n = lane_count > 1 ? count : 0; // a device keeps arrays with constant places in registers
        ++count;
        row[n] = c, grain[n] = i, pair[n] = materials, distance[n] = p.distance;
        Vec3 const velocity = pose.velocity_at(x - p.distance * p.normal) - flow;
        for (int axis = 0; axis < 3; ++axis) {
            normal[axis][n] = p.normal[axis];
            wall_velocity[axis][n] = velocity[axis];
            wall_spin[axis][n] = pose.angular_velocity[axis];
        }
    }
    /// Names the last row again in the lanes that are left: they compute and store the same.
    KOKKOS_FUNCTION void fill()
    {
        if constexpr (lane_count > 1)
            for (int n = count; n < lane_count; ++n) {
                row[n] = row[n - 1], grain[n] = grain[n - 1], pair[n] = pair[n - 1], distance[n] = distance[n - 1];
                for (int axis = 0; axis < 3; ++axis) {
                    normal[axis][n] = normal[axis][n - 1];
                    wall_velocity[axis][n] = wall_velocity[axis][n - 1];
                    wall_spin[axis][n] = wall_spin[axis][n - 1];
                }
            }
    }
};

KOKKOS_FORCEINLINE_FUNCTION Vector<Lanes> in_all_lanes(Vec3 const& v) { return {v.x, v.y, v.z}; }

KOKKOS_FORCEINLINE_FUNCTION Vector<Lanes> load_vectors(Real const (&columns)[3][lane_count])
{
    return {load_lanes(columns[0]), load_lanes(columns[1]), load_lanes(columns[2])};
}

/// The rows of some grains on their walls. Those of one grain on one wall, a group, are done together because on a mesh the
/// spring moves from facet to facet with the rolling or sliding grain. The rows of flat faces, which most are, need no such
/// care and go through the lanes as they come.
template <class Law> struct WallContactEvaluation {
    Law law;
    WallContactRows list;
    WallViews walls;
    RecordView position, velocity, spin;
    View1<std::uint8_t> material;
    PeriodicBox box;
    Real dt;
    StepGate gate = {};

    using Numbers = Vector<Lanes>;
    static constexpr int groups_at_once = lane_count > 1 ? 4 * lane_count : 1; // not all of them touch: lanes are to be full

    enum Touching : std::uint8_t { no = 0, yes = 1, ended = 2, begins = 3 };

    KOKKOS_FUNCTION void operator()(int block) const
    {
        if (gate.closed()) return;
        int const end = Kokkos::min((block + 1) * groups_at_once, list.groups);
        WallContactBatch batch;
        for (int g = block * groups_at_once; g < end;) {
            int const wall = wall_of_group(g);
            WallBody const& body = walls.body(wall);
            int const begin = g++;
            while (g < end && wall_of_group(g) == wall) ++g;
            if (has_flat_faces(body)) visit_flat(list.group(begin), list.group(g), body);
            else
                for (int k = begin; k < g; ++k) visit_group(list.group(k), list.group(k + 1), body, batch);
        }
        if (batch.count > 0) evaluate(batch);
    }

    KOKKOS_FUNCTION int wall_of_group(int g) const { return walls.wall_of_element(list.element(list.group(g))); }

    /// Rows first .. last - 1 of a wall of flat faces, lane_count of them at a time, touching or not.
    KOKKOS_FORCEINLINE_FUNCTION void visit_flat(int first, int last, WallBody const& body) const
    {
        Numbers const origin = in_all_lanes(body.pose.position), moves = in_all_lanes(body.pose.velocity);
        WallSurface wall;
        wall.spin = in_all_lanes(body.pose.angular_velocity);
        for (int c = first; c < last; c += lane_count) {
            WallContactLanes at;
            bool touched = false;
            ask_for_grains(c + lane_count);
            for (int n = 0; n < lane_count; ++n) { // the last row again in the lanes that are left
                at.row[n] = Kokkos::min(c + n, last - 1);
                at.grain[n] = list.grain(at.row[n]);
                touched = touched || list.touching(at.row[n]) != no;
            }
            Lanes level;
            find_faces(at, body, wall.normal, level);
            LaneRecords const grains = load_records(position.data(), at.grain);
            Numbers const from_origin = grains.xyz - origin;
            wall.distance = level + dot(wall.normal, from_origin);
            LaneMask touches = wall.distance < grains.w;
            if constexpr (Law::adheres) touches = touches || adhering(at);
            if (!touched && !any(touches)) continue;
            wall.velocity = moves + cross(wall.spin, from_origin - wall.distance * wall.normal);
            if (box.deforms()) wall.velocity -= box.stretch_velocity(grains.xyz - in_all_lanes(box.strain_origin));
            // Which code a row takes depends on its wall and the stage, not on the rows beside it.
            if (law.pairs.shared >= 0) {
                int const grains_material = law.pairs.shared / law.pairs.materials;
                for (int n = 0; n < lane_count; ++n) at.pair[n] = law.pairs.index(grains_material, body.material);
                evaluate<false>(at, grains.w, wall);
            } else {
                for (int n = 0; n < lane_count; ++n) at.pair[n] = law.pairs.index(material(at.grain[n]), body.material);
                evaluate_several(at, grains.w, wall);
            }
        }
    }

    /// Asks for the grains of rows c .. c + lane_count - 1, which lie apart in memory and may have been moved by another
    /// core.
    KOKKOS_FORCEINLINE_FUNCTION void ask_for_grains(int c) const
    {
        if constexpr (lane_count > 1)
            for (int n = 0; n < lane_count; ++n)
                ask_for_grain(list.grain(Kokkos::min(c + n, list.count - 1)), position, velocity, spin);
    }

    /// Normal and level [m] of the rows' faces, which are seldom different ones.
    KOKKOS_FORCEINLINE_FUNCTION void find_faces(WallContactLanes const& at, WallBody const& body, Numbers& normal,
                                                Lanes& level) const
    {
        FlatFace const face = flat_face(body, list.element(at.row[0]));
        normal = in_all_lanes(face.normal);
        level = face.level;
        if constexpr (lane_count > 1) {
            bool one = true;
            for (int n = 1; n < lane_count; ++n) one = one && list.element(at.row[n]) == list.element(at.row[0]);
            if (one) return;
            FlatFace faces[lane_count];
            for (int n = 0; n < lane_count; ++n) faces[n] = flat_face(body, list.element(at.row[n]));
            for (int axis = 0; axis < 3; ++axis) normal[axis] = make_lanes([&](int n) { return faces[n].normal[axis]; });
            level = make_lanes([&](int n) { return faces[n].level; });
        }
    }

    KOKKOS_FUNCTION LaneMask adhering(WallContactLanes const& at) const
    {
        return make_lanes([&](int n) { return Real(list.adhering(at.row[n])); }) > Lanes(0);
    }

    /// Rows first .. last - 1. Those that go on touching wait in the batch until it is full.
    KOKKOS_FUNCTION void visit_group(int first, int last, WallBody const& body, WallContactBatch& batch) const
    {
        int begun = 0, done = 0;
        for (int c = first; c < last; ++c) {
            bool touches = false;
            WallProximity const p = look(c, body, touches);
            bool const touched = list.touching(c);
            if (touches && touched) add(c, body, p, batch);
            else if (touches) list.touching(c) = begins, ++begun;
            else if (touched) list.touching(c) = ended, ++done;
        }
        if (begun + done == 0) return;
        if constexpr (Law::has_history || Law::adheres)
            if (done > 0 && last - first > 1 && body.shape == WallShape::mesh) hand_over(first, last, body);
        for (int c = first; c < last; ++c) {
            if (list.touching(c) == ended) clear(c);
            if (list.touching(c) != begins) continue;
            bool touches = false;
            WallProximity const p = look(c, body, touches);
            add(c, body, p, batch);
        }
    }

    KOKKOS_FUNCTION void add(int c, WallBody const& body, WallProximity const& p, WallContactBatch& batch) const
    {
        int const i = list.grain(c);
        Vec3 const x = vector_of(position, i);
        batch.add(c, i, law.pairs.index(material(i), body.material), p, body.pose, x,
                  box.stretch_velocity(x - box.strain_origin));
        if (batch.count < lane_count) return;
        evaluate(batch);
        batch.count = 0;
    }

    /// Where the row's element is to the grain, and whether the row carries a force.
    KOKKOS_FUNCTION WallProximity look(int c, WallBody const& body, bool& touches) const
    {
        int const i = list.grain(c);
        Real side = list.normal(c, 3);
        WallProximity const p = wall_proximity(walls, body, list.element(c), vector_of(position, i), position(i, 3), side);
        list.normal(c, 3) = side;
        touches = p.faces && p.distance < position(i, 3);
        if constexpr (Law::adheres) touches = touches || (p.faces && list.adhering(c));
        return p;
    }

    /// What a grain has left remembers its contact where it goes on: on the facet that it touches now or, stretched, on the
    /// one that it faces and that is nearest.
    KOKKOS_FUNCTION void hand_over(int first, int last, WallBody const& body) const
    {
        for (int c = first; c < last; ++c) {
            if (list.touching(c) != begins) continue;
            for (int from = first; from < last; ++from) {
                if (list.touching(from) != ended) continue;
                move_memory(from, c);
                break;
            }
        }
        if constexpr (Law::adheres)
            for (int from = first; from < last; ++from) {
                if (list.touching(from) != ended || !list.adhering(from)) continue;
                int const c = nearest_free(first, last, body);
                if (c < 0) continue;
                move_memory(from, c);
                list.touching(c) = begins;
            }
    }

    /// Of the rows that carry nothing and are faced by the grain, or -1.
    KOKKOS_FUNCTION int nearest_free(int first, int last, WallBody const& body) const
    {
        int nearest = -1;
        Real least = 0;
        for (int c = first; c < last; ++c) {
            if (list.touching(c) != no) continue;
            bool touches = false;
            WallProximity const p = look(c, body, touches);
            if (!p.faces || (nearest >= 0 && !(p.distance < least))) continue;
            nearest = c;
            least = p.distance;
        }
        return nearest;
    }

    KOKKOS_FUNCTION void move_memory(int from, int to) const
    {
        for (int n = 0; n < 3; ++n) list.normal(to, n) = list.normal(from, n);
        if constexpr (Law::adheres) list.adhering(to) = list.adhering(from);
        if constexpr (Law::has_history)
            for (int n = 0; n < 4; ++n) list.spring(to, n) = list.spring(from, n);
        clear(from);
    }

    KOKKOS_FUNCTION void clear(int c) const
    {
        list.touching(c) = no;
        if constexpr (Law::adheres) list.adhering(c) = 0;
        if constexpr (Law::has_history)
            for (int n = 0; n < 4; ++n) list.spring(c, n) = 0;
        for (int n = 0; n < 8; ++n) list.force(c, n) = 0;
    }

    KOKKOS_FUNCTION void evaluate(WallContactBatch& batch) const
    {
        batch.fill();
        evaluate_several(batch, load_records(position.data(), batch.grain).w,
                         {load_vectors(batch.normal), load_lanes(batch.distance), load_vectors(batch.wall_velocity),
                          load_vectors(batch.wall_spin)});
    }

    KOKKOS_FUNCTION void evaluate_several(WallContactLanes const& at, Lanes const& radius, WallSurface const& wall) const
    {
        evaluate<true>(at, radius, wall);
    }

    /// radius [m]: of the grains. several: the lanes may hold different pairs of materials. A row that does not touch any
    /// more is left with its normal alone.
    template <bool several>
    KOKKOS_FORCEINLINE_FUNCTION void evaluate(WallContactLanes const& at, Lanes const& radius, WallSurface const& wall) const
    {
        LaneRecords const moving = load_records(velocity.data(), at.grain), turning = load_records(spin.data(), at.grain);
        ContactGeometry<Lanes> contact;
        contact.normal = wall.normal;
        contact.overlap = radius - wall.distance;
        contact.motion =
            surface_motion(moving.xyz - wall.distance * cross(turning.xyz, contact.normal) - wall.velocity, contact.normal);
        contact.scale = {radius, moving.w, 0};
        ContactState<Lanes> state;
        if constexpr (Law::adheres) {
            contact.scale.inverse_cube_root = make_lanes([&](int n) { return 1 / Kokkos::cbrt(lane(radius, n)); });
            state.adhering = adhering(at);
        }
        LaneRecords const before = load_records(list.normal.data(), at.row); // the normal of the last step, and the side
        if constexpr (Law::has_history) {
            LaneRecords const spring = load_records(list.spring.data(), at.row);
            state.previous_radius = spring.w;
            Lanes const twist = Real(0.5) * dt * dot(turning.xyz + wall.spin, contact.normal);
            // Without a spring there may have been no normal before.
            LaneMask const stretched = dot(spring.xyz, spring.xyz) > Lanes(0);
            LineTurn<Lanes> const turn = contact_turn(before.xyz, contact.normal);
            state.spring = select(stretched, transport_spring(spring.xyz, turn, twist), Numbers{});
        }
        Numbers force;
        Lanes stiffness = 0; // S_n = 2 E* a, Hertz
        Lanes const hertz_radius = square_root(radius * larger(contact.overlap, Lanes(0)));
        if constexpr (several) {
            ContactState<Lanes> const entering = state;
            for_each_material_pair(law.pairs, at.pair, [&](PairConstants const& pair, LaneMask const& same) {
                ContactState<Lanes> after = entering;
                force = select(same, law(contact, pair, after, dt), force);
                stiffness = select(same, 2 * pair.effective_youngs_modulus * hertz_radius, stiffness);
                state = select(same, after, state);
            });
        } else {
            PairConstants const& pair = law.pairs(at.pair[0]);
            force = law(contact, pair, state, dt);
            stiffness = 2 * pair.effective_youngs_modulus * hertz_radius;
        }
        store(at, {contact.normal, before.w}, force, wall.distance, stiffness, state);
    }

    /// A row that has come apart keeps nothing but its normal.
    KOKKOS_FORCEINLINE_FUNCTION void store(WallContactLanes const& at, LaneRecords const& normal, Numbers const& force,
                                           Lanes const& distance, Lanes const& stiffness,
                                           ContactState<Lanes> const& state) const
    {
        Lanes const touching = select(state.touching, Lanes(1), Lanes(0)),
                    adhering = select(state.adhering, Lanes(1), Lanes(0));
        for (int n = 0; n < lane_count; ++n) {
            list.touching(at.row[n]) = lane(touching, n) > 0 ? yes : no;
            if constexpr (Law::adheres) list.adhering(at.row[n]) = lane(touching, n) > 0 && lane(adhering, n) > 0;
        }
        store_records(normal, list.normal.data(), at.row);
        if constexpr (Law::has_history) store_records({state.spring, state.previous_radius}, list.spring.data(), at.row);
        auto const half = [&](int n, int which) {
            return list.force.data() + 8 * static_cast<std::ptrdiff_t>(at.row[n]) + 4 * which;
        };
        store_records_at({force, select(state.touching, distance, Lanes(0))}, [&](int n) { return half(n, 0); });
        store_records_at({cross(normal.xyz, force), select(state.touching, stiffness, Lanes(0))},
                         [&](int n) { return half(n, 1); });
    }
};

} // namespace arenite
