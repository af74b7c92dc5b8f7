// SPDX-License-Identifier: MIT
// Forces of walls on grains, under a contact law chosen outside the step. A wall is a body of infinite radius and mass:
// R* = R_i, m* = m_i, and the arm reaches from the grain's centre to the wall's nearest point.
#pragma once

#include "kernels/contact/contact_law.hpp"
#include "kernels/step_gate.hpp"
#include "kernels/wall_contacts.hpp"

namespace arenite {

/// The rows of one grain on one wall. They are done together because on a mesh the spring moves from facet to
/// facet with the rolling or sliding grain.
template <class Law> struct WallContactEvaluation {
    Law law;
    WallContactRows list;
    WallViews walls;
    RecordView position, velocity, spin;
    View1<std::uint8_t> material;
    Real dt;
    StepGate gate = {};

    enum Touching : std::uint8_t { no = 0, yes = 1, ended = 2, begins = 3 };

    KOKKOS_FUNCTION void operator()(int g) const
    {
        if (gate.closed()) return;
        int const first = list.group(g), last = list.group(g + 1);
        WallBody const& body = walls.body(walls.wall_of_element(list.element(first)));
        int begun = 0;
        for (int c = first; c < last; ++c) begun += visit(c, body);
        if (begun > 0 && Law::has_history && last - first > 1 && body.shape == WallShape::mesh) hand_over(first, last);
        for (int c = first; c < last; ++c) {
            if (list.touching(c) == begins) evaluate(c, body);
            if (list.touching(c) == ended) clear(c);
        }
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

    /// Evaluates a row that goes on touching; marks rows that begin or end. 1 for one that begins.
    KOKKOS_FUNCTION int visit(int c, WallBody const& body) const
    {
        bool touches = false;
        WallProximity const p = look(c, body, touches);
        if (touches && list.touching(c)) evaluate_at(c, body, p);
        else if (touches) list.touching(c) = begins;
        else if (list.touching(c)) list.touching(c) = ended;
        return touches && list.touching(c) == begins;
    }

    KOKKOS_FUNCTION void hand_over(int first, int last) const
    {
        for (int c = first; c < last; ++c) {
            if (list.touching(c) != begins) continue;
            for (int from = first; from < last; ++from) {
                if (list.touching(from) != ended) continue;
                for (int n = 0; n < 3; ++n) list.normal(c, n) = list.normal(from, n);
                if constexpr (Law::has_history)
                    for (int n = 0; n < 4; ++n) list.spring(c, n) = list.spring(from, n);
                clear(from);
                break;
            }
        }
    }

    KOKKOS_FUNCTION void clear(int c) const
    {
        list.touching(c) = no;
        if constexpr (Law::adheres) list.adhering(c) = 0;
        if constexpr (Law::has_history)
            for (int n = 0; n < 4; ++n) list.spring(c, n) = 0;
        for (int n = 0; n < 8; ++n) list.force(c, n) = 0;
    }

    KOKKOS_FUNCTION void evaluate(int c, WallBody const& body) const
    {
        bool touches = false;
        WallProximity const p = look(c, body, touches);
        evaluate_at(c, body, p);
    }

    KOKKOS_FUNCTION void evaluate_at(int c, WallBody const& body, WallProximity const& p) const
    {
        int const i = list.grain(c);
        Vec3 const x = vector_of(position, i), spin_i = vector_of(spin, i);
        Real const radius = position(i, 3);
        PairConstants const& pair = law.pairs(material(i), body.material);
        ContactGeometry<> contact;
        contact.normal = p.normal;
        contact.overlap = radius - p.distance;
        contact.motion = surface_motion(vector_of(velocity, i) - p.distance * cross(spin_i, p.normal) -
                                            body.pose.velocity_at(x - p.distance * p.normal),
                                        p.normal);
        contact.scale = {radius, velocity(i, 3), Law::adheres ? Kokkos::cbrt(radius) : Real(0)};
        ContactState<> state;
        if constexpr (Law::adheres) state.adhering = list.adhering(c);
        if constexpr (Law::has_history) {
            Vec3 const spring = vector_of(list.spring, c);
            state.previous_radius = list.spring(c, 3);
            if (dot(spring, spring) > 0) {
                Real const twist = Real(0.5) * dt * dot(spin_i + body.pose.angular_velocity, p.normal);
                state.spring = transport_spring(spring, vector_of(list.normal, c), p.normal, twist);
            }
        }
        Vec3 const force = law(contact, pair, state, dt);
        if (!state.touching) return clear(c);
        list.touching(c) = yes;
        if constexpr (Law::adheres) list.adhering(c) = state.adhering;
        if constexpr (Law::has_history) {
            set_vector(list.spring, c, state.spring);
            list.spring(c, 3) = state.previous_radius;
        }
        set_vector(list.normal, c, p.normal);
        store(c, force, p, pair, radius);
    }

    KOKKOS_FUNCTION void store(int c, Vec3 const& force, WallProximity const& p, PairConstants const& pair,
                               Real radius) const
    {
        Real const overlap = Kokkos::fmax(radius - p.distance, Real(0));
        Vec3 const moment = cross(p.normal, force);
        list.force(c, 0) = force.x;
        list.force(c, 1) = force.y;
        list.force(c, 2) = force.z;
        list.force(c, 3) = p.distance;
        list.force(c, 4) = moment.x;
        list.force(c, 5) = moment.y;
        list.force(c, 6) = moment.z;
        list.force(c, 7) = 2 * pair.effective_youngs_modulus * Kokkos::sqrt(radius * overlap); // S_n = 2 E* a, Hertz
    }
};

template <class Law>
void evaluate_wall_contacts(Law const& law, Particles const& particles, Walls const& walls, WallContacts const& contacts,
                            Real dt, StepGate const& gate = {})
{
    if (contacts.groups == 0) return;
    Kokkos::parallel_for("evaluate_wall_contacts", RangePolicy(0, contacts.groups),
                         WallContactEvaluation<Law>{law, contacts, walls.views, particles.position, particles.velocity,
                                                    particles.spin, particles.material, dt, gate});
}

} // namespace arenite
