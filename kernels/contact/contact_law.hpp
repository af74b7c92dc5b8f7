// SPDX-License-Identifier: MIT
// A contact law: a normal law and a tangential law, with the dashpots of restitution. Numbers in, numbers
// out: no Views, ids or time, so the same function is tested on the host and run in kernels, for pairs
// of grains and for grains on walls.
#pragma once

#include "kernels/contact/jkr.hpp"
#include "kernels/contact/tangential.hpp"

namespace arenite {

struct ContactGeometry {
    Vec3 normal;    // unit, from j to i
    Real overlap;   // m, > 0 when the spheres interpenetrate
    Vec3 velocity;  // m/s, of i's surface relative to j's at the contact
    ContactScale scale;
};

/// What a contact remembers from step to step.
struct ContactState {
    Vec3 spring;                // xi, m, in the contact plane
    Real previous_radius = 0;   // a at the last step, m
    std::uint8_t adhering = 0;  // follows the JKR curve
    std::uint8_t touching = 0;  // carried a force at the last step
};

template <class Normal, class Tangential> struct ContactLaw {
    static constexpr bool adheres = Normal::adheres;
    static constexpr bool has_history = Tangential::has_history;

    PairTable pairs;

    /// Force on i [N] (on j: the opposite); the spring must have been transported to the new normal.
    KOKKOS_FUNCTION Vec3 operator()(ContactGeometry const& contact, PairConstants const& pair, ContactState& state,
                                    Real dt) const
    {
        NormalResponse response = Normal{}(contact.overlap, contact.scale, pair, state.adhering);
        state.touching = response.touches;
        if (!response.touches) {
            state.spring = {};
            state.previous_radius = 0;
            return {};
        }
        Real const normal_velocity = dot(contact.velocity, contact.normal);
        Real const stiffness = 2 * pair.effective_youngs_modulus * response.contact_radius;
        response.dashpot = pair.damping_factor * Kokkos::sqrt(stiffness * contact.scale.effective_mass);
        Real normal_force = response.force - response.dashpot * normal_velocity; // paper eq 32, velocity outside the root
        if (pair.clip_attraction && !(response.pull_off_force > 0)) normal_force = Kokkos::fmax(normal_force, Real(0));
        Vec3 const slip = contact.velocity - normal_velocity * contact.normal;
        Vec3 const tangential =
            Tangential{}(slip, response, normal_force, pair, state.spring, state.previous_radius, dt);
        return normal_force * contact.normal + tangential;
    }
};

} // namespace arenite
