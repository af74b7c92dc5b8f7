// SPDX-License-Identifier: MIT
// The terms of the balance sheet: what contacts, walls and outer forces do to the grains at one moment, by mechanism, and
// what contacts hold. Positions, velocities, forces and contact memory must be of one time (after a kick). Runs that
// ask for no balance never call these; sums are in fixed order.
#pragma once

#include "core/reproducible_sum.hpp"
#include "kernels/contact_lanes.hpp"
#include "kernels/diagnostics.hpp"
#include "kernels/wall_contacts.hpp"

namespace arenite {

/// Powers [W] and energies [J] of grain-grain or grain-wall contacts, in the order of the sums that they come from.
struct ContactPower {
    Real damping = 0;    // W, of the normal dashpots on the two bodies: negative where they slow
    Real tangential = 0; // W, of springs and dashpots in the contact plane
    Vec3 virial;         // J, sum of force x offset along each axis; a box of strain rate e puts -e . virial in
    Real walls = 0;      // W of moving walls on the grains
    Real on_grains = 0;  // W on velocities and spins of grains, all mechanisms
    Real adhesion = 0;   // J by which stored energy jumped where contacts began or ceased to adhere in this step
};

struct StoredEnergy {
    Real elastic = 0;    // J, of compressed and stretched contacts, 0 without contact
    Real adhesive = 0;   // J, -2 gamma pi a^2 of the surfaces that stick
    Real tangential = 0; // J, 1/2 S_t xi^2

    KOKKOS_FUNCTION Real total() const { return elastic + adhesive + tangential; }
};

/// Powers of forces that are not of contacts, W, likewise.
struct GrainPower {
    Real gravity = 0, applied = 0;
    Real drag = 0, pressure = 0; // of the fluid: on the slip, and of -grad p + div tau
    Real held = 0;               // of what holds or moves grains whatever the forces
    Vec3 virial;                 // J, of the forces but those that hold: sum of force x (place - origin) along each axis
    Real total = 0;              // of the grains' total force and torque
    KOKKOS_FUNCTION Real outer() const { return gravity + applied + drag + pressure; }
};

inline constexpr int contact_power_terms = 8, grain_power_terms = 9;

KOKKOS_FUNCTION inline ContactPower contact_power(Real const* sums)
{
    return {sums[0], sums[1], {sums[2], sums[3], sums[4]}, sums[5], sums[6], sums[7]};
}
KOKKOS_FUNCTION inline GrainPower grain_power(Real const* sums)
{
    return {sums[0], sums[1], sums[2], sums[3], sums[4], {sums[5], sums[6], sums[7]}, sums[8]};
}

/// What grain_power is made of, to `to`, as reproducible_sums_to does it: nobody waits. gravity [m/s2]; the box for its
/// strain rate, which is about origin [m].
void sum_grain_power(Real* to, Particles const& particles, Vec3 const& gravity, PeriodicBox const& box, Vec3 const& origin,
                     SumWorkspace& sums);

/// Elastic and surface energy of a normal contact: they add up to the work of its force from the state without contact.
KOKKOS_FUNCTION inline StoredEnergy stored_energy(Real overlap, bool adheres, ContactScale<> const& scale,
                                                  PairConstants const& pair)
{
    StoredEnergy energy;
    if (!adheres) {
        if (overlap > 0) energy.elastic = hertz_energy(overlap, scale.effective_radius, pair.effective_youngs_modulus);
        return energy;
    }
    Real const radius = jkr_response(overlap, scale, pair).contact_radius;
    energy.adhesive = -2 * std::numbers::pi_v<Real> * pair.surface_energy * radius * radius;
    energy.elastic = jkr_potential(overlap, scale, pair) - energy.adhesive;
    return energy;
}

/// Contacts as the sheet sees them: normal, force on the first body, power of the whole force.
template <class N = Real> struct ContactMotion {
    Vector<N> normal, force, velocity; // velocity: of the first body's centre relative to the second's (or to the wall)
    N total = 0;                       // W, with spins
    N overlap = 0, contact_radius = 0; // m; a radius of 0 is not known
    MaskOf<N> touching = MaskOf<N>(false);
};

/// W of the normal dashpot and of everything in the contact plane.
template <class N> struct SplitPower {
    N damping = 0, tangential = 0;
};

/// scale(): the contact's ContactScale, asked for only where the radius is not known.
template <class Law, class N, class Scale>
KOKKOS_FORCEINLINE_FUNCTION SplitPower<N> split_contact_power(ContactMotion<N> const& contact, N const& effective_radius,
                                                              PairConstants const& pair, MaskOf<N> adheres,
                                                              Scale const& scale)
{
    using Normal = typename Law::NormalPart;
    N elastic = Normal::force_at_radius(contact.contact_radius, effective_radius, pair, adheres);
    if (any(contact.touching && !(contact.contact_radius > N(0)))) [[unlikely]]
        elastic = Normal{}(contact.overlap, scale(), pair, adheres).force;
    N const along = dot(contact.force, contact.normal), approach = dot(contact.velocity, contact.normal);
    return {(along - elastic) * approach, contact.total - along * approach};
}

/// Jump of the stored energy where a contact began (now) or ceased (before) to adhere.
KOKKOS_FUNCTION inline Real adhesion_jump(bool before, bool now, Real overlap, ContactScale<> const& scale,
                                          PairConstants const& pair)
{
    if (before == now) return 0;
    Real const jump = stored_energy(overlap, true, scale, pair).total() - stored_energy(overlap, false, scale, pair).total();
    return now ? jump : -jump;
}

/// Sums over the lane_count contacts of a block, in the order of contact_power.
template <class Law> struct PairPower {
    PairTable pairs;
    ContactList list;
    RecordView position, velocity, spin;
    View1<std::uint8_t> material;
    View1<std::uint8_t> adhered; // the flags when this was last looked at, which it then follows, or empty
    PeriodicBox box;
    BlockTurns turns{whole_step(list), 1};

    /// Of the k-th block.
    KOKKOS_FORCEINLINE_FUNCTION LaneTerms<8> operator()(int k) const
    {
        LaneTerms<8> terms{};
        int const c = turns(k).begin * lane_count;
        if constexpr (Law::adheres)
            if (adhered.extent(0) > 0) terms[7] = adhesion_jumps(c);
        LaneMask touching = load_flags(&list.touching(c));
        if (!any(touching)) return terms;
        int const *const i = &list.first(c), *const j = &list.second(c);
        ask_for_later(j, position, velocity, spin);
        LaneRecords const between = load_differences(position.data(), i, j, 1); // and the sum of the radii
        Vector<Lanes> offset = between.xyz;
        if (list.periodic) offset -= image_shifts(list, box, c);
        Lanes const distance = square_root(dot(offset, offset));
        touching = touching && distance > Lanes(0);

        int force_rows[lane_count], moment_rows[lane_count];
        for (int n = 0; n < lane_count; ++n) moment_rows[n] = (force_rows[n] = 2 * (c + n)) + 1;
        LaneRecords const force = load_records(list.force.data(), force_rows);   // on i, arm of i
        LaneRecords const moment = load_records(list.force.data(), moment_rows); // n x F, arm of j
        ContactMotion<Lanes> contact;
        contact.overlap = between.w - distance;
        contact.normal = select(touching, 1 / distance, Lanes(0)) * offset;
        contact.force = force.xyz;
        Vector<Lanes> const approach = load_differences(velocity.data(), i, j, -1).xyz;
        contact.velocity = approach + box.stretch_velocity(offset);
        Lanes const turning = -dot(moment.xyz, force.w * records_of(spin, i).xyz + moment.w * records_of(spin, j).xyz);
        contact.total = dot(contact.force, contact.velocity) + turning;
        contact.touching = touching;
        if (list.needs.contact_radius) contact.contact_radius = load_lanes(&list.contact_radius(c));
        LaneMask adheres(false);
        if constexpr (Law::adheres) adheres = load_flags(&list.adhering(c));
        SplitPower<Lanes> const split = split_power(contact, c, adheres);
        auto const sum = [&](Lanes const& power) { return select(touching, power, Lanes(0)); };
        terms[0] = sum(split.damping);
        terms[1] = sum(split.tangential);
        for (int axis = 0; axis < 3; ++axis) terms[2 + axis] = sum(contact.force[axis] * offset[axis]);
        terms[6] = sum(dot(contact.force, approach) + turning);
        return terms;
    }

    KOKKOS_FORCEINLINE_FUNCTION SplitPower<Lanes> split_power(ContactMotion<Lanes> const& contact, int c,
                                                              LaneMask const& adheres) const
    {
        auto const split_for = [&](PairConstants const& pair) {
            return split_contact_power<Law>(contact, load_lanes(&list.scale(c, 0)), pair, adheres,
                                            [&] { return load_scale<Law::adheres>(list, c); });
        };
        if (pairs.shared >= 0) return split_for(pairs(pairs.shared));
        SplitPower<Lanes> split;
        for_each_material_pair(pairs, material, &list.first(c), &list.second(c),
                               [&](PairConstants const& pair, LaneMask const& same) {
                                   SplitPower<Lanes> const power = split_for(pair);
                                   split.damping = select(same, power.damping, split.damping);
                                   split.tangential = select(same, power.tangential, split.tangential);
                               });
        return split;
    }

    /// Rare, so contact by contact.
    KOKKOS_FUNCTION Lanes adhesion_jumps(int c) const
    {
        if (!any(load_flags(&adhered(c)) != load_flags(&list.adhering(c)))) return 0;
        return make_lanes([&](int lane) -> Real {
            int const n = c + lane;
            if (n >= list.count || adhered(n) == list.adhering(n)) return 0;
            int const i = list.first(n), j = list.second(n);
            Real const overlap = position(i, 3) + position(j, 3) - norm(contact_offset(list, position, box, n));
            bool const before = adhered(n), now = list.adhering(n);
            adhered(n) = now;
            return adhesion_jump(before, now, overlap, scale_of(list, n), pairs(material(i), material(j)));
        });
    }
};

/// Of a wall at its contact, m/s.
KOKKOS_FUNCTION inline Vec3 wall_velocity(WallContactRows const& list, WallPose const& pose, RecordView const& position,
                                          int c)
{
    return pose.velocity_at(vector_of(position, list.grain(c)) - list.force(c, 3) * vector_of(list.normal, c));
}

template <class Law> struct WallPower {
    PairTable pairs;
    WallContactRows list;
    WallViews walls;
    RecordView position, velocity, spin;
    View1<std::uint8_t> material, adhered;
    PeriodicBox box;
    Vec3 origin;

    KOKKOS_FUNCTION Terms<8> operator()(int c) const
    {
        Terms<8> terms{};
        bool now = false, before = false;
        if constexpr (Law::adheres)
            if (adhered.extent(0) > 0) {
                before = adhered(c);
                adhered(c) = now = list.adhering(c);
            }
        if (!list.touching(c))
            return terms; // where a wall's contact snapped its row is empty: that jump stays in the residual
        int const i = list.grain(c);
        WallBody const& body = walls.body(walls.wall_of_element(list.element(c)));
        PairConstants const& pair = pairs(material(i), body.material);
        Real const radius = position(i, 3), arm = list.force(c, 3);
        auto const scale = [&] { return ContactScale<>{radius, velocity(i, 3), 1 / Kokkos::cbrt(radius)}; };
        ContactMotion<> contact;
        contact.touching = true;
        if constexpr (Law::has_history) contact.contact_radius = list.spring(c, 3);
        contact.overlap = radius - arm;
        contact.normal = vector_of(list.normal, c);
        contact.force = {list.force(c, 0), list.force(c, 1), list.force(c, 2)};
        Vec3 const moment{list.force(c, 4), list.force(c, 5), list.force(c, 6)}, x = vector_of(position, i);
        Vec3 const offset = x - origin, wall = wall_velocity(list, body.pose, position, c);
        contact.velocity = vector_of(velocity, i) + box.stretch_velocity(offset) - wall;
        Real const turning = -arm * dot(moment, vector_of(spin, i));
        contact.total = dot(contact.force, contact.velocity) + turning;
        if constexpr (Law::adheres) now = list.adhering(c);
        SplitPower<Real> const split = split_contact_power<Law>(contact, radius, pair, now, scale);
        terms[0] = split.damping;
        terms[1] = split.tangential;
        for (int axis = 0; axis < 3; ++axis) terms[2 + axis] = contact.force[axis] * offset[axis];
        terms[5] = dot(contact.force, wall);
        terms[6] = dot(contact.force, vector_of(velocity, i)) + turning;
        if constexpr (Law::adheres)
            if (before != now) terms[7] = adhesion_jump(before, now, contact.overlap, scale(), pair);
        return terms;
    }
};

/// W of moving walls on the grains.
struct WallWork {
    WallContactRows list;
    WallViews walls;
    RecordView position;

    KOKKOS_FUNCTION Terms<1> operator()(int c) const
    {
        if (!list.touching(c)) return {{0}};
        Vec3 const force{list.force(c, 0), list.force(c, 1), list.force(c, 2)};
        WallPose const& pose = walls.body(walls.wall_of_element(list.element(c))).pose;
        return {{dot(force, wall_velocity(list, pose, position, c))}};
    }
};

template <class Law> struct PairEnergy {
    ContactTerms<Law> contacts;

    KOKKOS_FUNCTION Terms<3> operator()(int c) const
    {
        auto const v = contacts.values(c);
        if (!v.touching) return {{0, 0, 0}};
        ContactList const& list = contacts.list;
        PairConstants const& pair = contacts.pairs(contacts.material(list.first(c)), contacts.material(list.second(c)));
        StoredEnergy const energy = stored_energy(v.overlap, v.adhering, scale_of(list, c), pair);
        return {{energy.elastic, energy.adhesive, v.tangential}};
    }
};

template <class Law> struct WallEnergy {
    PairTable pairs;
    WallContactRows list;
    WallViews walls;
    RecordView position, velocity;
    View1<std::uint8_t> material;

    /// As StoredEnergy, and above the force-free state.
    KOKKOS_FUNCTION Terms<4> operator()(int c) const
    {
        if (!list.touching(c)) return {{0, 0, 0, 0}};
        int const i = list.grain(c);
        PairConstants const& pair = pairs(material(i), walls.body(walls.wall_of_element(list.element(c))).material);
        Real const radius = position(i, 3), overlap = radius - list.force(c, 3);
        ContactScale<> const scale{radius, velocity(i, 3), 1 / Kokkos::cbrt(radius)};
        bool adheres = false;
        if constexpr (Law::adheres) adheres = list.adhering(c);
        StoredEnergy const energy = stored_energy(overlap, adheres, scale, pair);
        Real tangential = 0;
        if constexpr (Law::has_history) {
            Vec3 const spring = vector_of(list.spring, c);
            tangential = 4 * pair.effective_shear_modulus * list.spring(c, 3) * dot(spring, spring);
        }
        Real const above = adheres ? jkr_energy(overlap, scale, pair) : energy.elastic;
        return {{energy.elastic, energy.adhesive, tangential, above + tangential}};
    }
};

} // namespace arenite
