// SPDX-License-Identifier: MIT
// A contact law: a normal law and a tangential law, with the dashpots of restitution. Numbers in, numbers
// out: no Views, ids or time, so the same function is tested on the host and run in kernels, for pairs
// of grains and for grains on walls.
#pragma once

#include "kernels/contact/jkr.hpp"
#include "kernels/contact/tangential.hpp"

namespace arenite {

template <class N = Real> struct ContactGeometry {
    Vector<N> normal; // unit, from j to i
    N overlap = 0;    // m, > 0 when the spheres interpenetrate
    SurfaceMotion<N> motion;
    ContactScale<N> scale;
};

/// What a contact remembers from step to step.
template <class N = Real> struct ContactState {
    Vector<N> spring;                      // xi, m, in the contact plane
    N previous_radius = 0;                 // a at the last step, m
    MaskOf<N> adhering = MaskOf<N>(false); // follows the JKR curve
    MaskOf<N> touching = MaskOf<N>(false); // carried a force at the last step
};

template <class N>
KOKKOS_FORCEINLINE_FUNCTION ContactState<N> select(MaskOf<N> const& mask, ContactState<N> const& a, ContactState<N> const& b)
{
    return {select(mask, a.spring, b.spring), select(mask, a.previous_radius, b.previous_radius),
            select(mask, a.adhering, b.adhering), select(mask, a.touching, b.touching)};
}

template <class Normal, class Tangential> struct ContactLaw {
    static constexpr bool adheres = Normal::adheres;
    static constexpr bool has_history = Tangential::has_history;
    using NormalPart = Normal;

    PairTable pairs;

    /// Force on i [N] (on j: the opposite); the spring must have been transported to the new normal. A contact that does
    /// not touch has no force and forgets its spring.
    template <class N>
    KOKKOS_FORCEINLINE_FUNCTION Vector<N> operator()(ContactGeometry<N> const& contact, PairConstants const& pair,
                                                     ContactState<N>& state, Real dt) const
    {
        NormalResponse<N> const response = Normal{}(contact.overlap, contact.scale, pair, state.adhering);
        state.touching = response.touches;
        // Paper eq 32, velocity outside the root.
        N normal_force = response.force - (pair.damping_factor * contact.motion.normal_velocity) * response.impedance;
        if (pair.clip_attraction)
            normal_force = select(response.pull_off_force > N(0), normal_force, larger(normal_force, N(0)));
        Vector<N> const tangential = Tangential{}.template operator()<Normal::radius_is_late>(
            contact.motion.slip, response, normal_force, pair, state.spring, state.previous_radius, dt);
        if constexpr (has_history) {
            state.spring = select(state.touching, state.spring, Vector<N>{});
            state.previous_radius = select(state.touching, state.previous_radius, N(0));
        }
        return select(state.touching, normal_force * contact.normal + tangential, Vector<N>{});
    }
};

} // namespace arenite
