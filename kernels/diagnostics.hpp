// SPDX-License-Identifier: MIT
// What the run reports about its grains: counts, energies, extremes. Sums are in fixed order.
#pragma once

#include "core/contact_list.hpp"
#include "core/particles.hpp"
#include "core/reproducible_sum.hpp"
#include "kernels/contact/contact_law.hpp"

#include <numbers>

namespace arenite {

/// Sizes of a contact, as the list keeps them.
KOKKOS_FUNCTION inline ContactScale<> scale_of(ContactList const& list, int c)
{
    return {list.scale(c, 0), list.scale(c, 1), list.needs.bonds ? list.inverse_cube_root(c) : Real(0)};
}

struct GrainReport {
    Real translation = 0, rotation = 0; // kinetic energy, J
    Real mass = 0;                      // kg
    Real volume = 0;                    // m3 of grains
    Vec3 momentum;                      // kg m/s

    Real kinetic_energy() const { return translation + rotation; }
};

struct ContactReport {
    long long touching = 0, adhering = 0;
    Real elastic = 0;               // J, normal: above the force-free state (Hertz overlap 0, JKR point B)
    Real tangential = 0;            // J, 1/2 S_t xi^2
    Real highest_overlap_ratio = 0; // overlap / smaller radius
    Real stiffness = 0;             // N/m, largest normal stiffness of a contact

    Real energy() const { return elastic + tangential; }
};

GrainReport report_grains(Particles const& particles, SumWorkspace& workspace);

/// Stored energy of a normal contact above its force-free state, J.
KOKKOS_FUNCTION inline Real hertz_energy(Real overlap, Real effective_radius, Real effective_youngs_modulus)
{
    return Real(8) / 15 * effective_youngs_modulus * Kokkos::sqrt(effective_radius * overlap) * overlap * overlap;
}

/// Work of the JKR force from a = 0 to the root y, over pi gamma R* L: 8/15 s^5 - 8/3 s^(7/2) + 2 s^2, s = y^2
/// (integral of eqs 12, 13).
KOKKOS_FUNCTION inline Real jkr_work(Real y)
{
    Real const y4 = y * y * y * y;
    return y4 * (Real(8) / 15 * y4 * y * y - Real(8) / 3 * y * y * y + 2);
}

KOKKOS_FUNCTION inline Real jkr_energy_unit(ContactScale<> const& scale, PairConstants const& pair)
{
    return std::numbers::pi_v<Real> * pair.surface_energy * scale.effective_radius * pair.length_factor /
           scale.inverse_cube_root;
}

/// J at the overlap, above the state without contact.
KOKKOS_FUNCTION inline Real jkr_potential(Real overlap, ContactScale<> const& scale, PairConstants const& pair)
{
    return jkr_energy_unit(scale, pair) * jkr_work(jkr_root(overlap * jkr_inverse_length(scale, pair)));
}

/// J at the overlap, above the force-free point B.
KOKKOS_FUNCTION inline Real jkr_energy(Real overlap, ContactScale<> const& scale, PairConstants const& pair)
{
    constexpr Real y_B = 1.4422495703074083; // s_B = 9^(1/3), y_B = 3^(1/3)
    return jkr_potential(overlap, scale, pair) - jkr_energy_unit(scale, pair) * jkr_work(y_B);
}

template <class Law> struct ContactTerms {
    PairTable pairs;
    ContactList list;
    RecordView position;
    View1<std::uint8_t> material;
    PeriodicBox box;

    struct Values {
        Real elastic = 0, tangential = 0, overlap = 0, overlap_ratio = 0, stiffness = 0;
        bool touching = false, adhering = false;
    };

    KOKKOS_FUNCTION Values values(int c) const
    {
        Values v;
        v.touching = list.touching(c);
        if (!v.touching) return v;
        int const i = list.first(c), j = list.second(c);
        Real const overlap = position(i, 3) + position(j, 3) - norm(contact_offset(list, position, box, c));
        v.overlap = overlap;
        PairConstants const pair = pairs(material(i), material(j));
        ContactScale<> const scale = scale_of(list, c);
        Real radius = Kokkos::sqrt(scale.effective_radius * Kokkos::fmax(overlap, Real(0)));
        v.overlap_ratio = overlap / Kokkos::fmin(position(i, 3), position(j, 3));
        if constexpr (Law::adheres) v.adhering = list.adhering(c);
        if (v.adhering) {
            v.elastic = jkr_energy(overlap, scale, pair);
            radius = jkr_response(overlap, scale, pair).contact_radius;
        } else if (overlap > 0) {
            v.elastic = hertz_energy(overlap, scale.effective_radius, pair.effective_youngs_modulus);
        }
        v.stiffness = 2 * pair.effective_youngs_modulus * radius;
        if constexpr (Law::has_history) {
            Vec3 const spring = vector_of(list.spring, c);
            v.tangential = 4 * pair.effective_shear_modulus * radius * dot(spring, spring);
        }
        return v;
    }
    KOKKOS_FUNCTION Terms<4> operator()(int c) const
    {
        Values const v = values(c);
        return {{v.elastic, v.tangential, v.touching ? Real(1) : Real(0), v.adhering ? Real(1) : Real(0)}};
    }
};

template <class Terms_> struct ContactExtremes { // largest overlap ratio and stiffness
    Terms_ terms;
    KOKKOS_FUNCTION void operator()(int c, Real& overlap_ratio, Real& stiffness) const
    {
        auto const v = terms.values(c);
        overlap_ratio = Kokkos::fmax(overlap_ratio, v.overlap_ratio);
        stiffness = Kokkos::fmax(stiffness, v.stiffness);
    }
};

template <class Law>
ContactReport report_contacts(Law const& law, Particles const& particles, PeriodicBox const& box,
                              ContactList const& contacts, SumWorkspace& workspace)
{
    ContactReport report;
    if (contacts.count == 0) return report;
    ContactTerms<Law> const terms{law.pairs, contacts, particles.position, particles.material, box};
    Terms<4> const sums = reproducible_sums<4>(workspace, "report_contacts", contacts.count, terms);
    report.elastic = sums[0];
    report.tangential = sums[1];
    report.touching = static_cast<long long>(sums[2]);
    report.adhering = static_cast<long long>(sums[3]);
    Kokkos::parallel_reduce("contact_extremes", RangePolicy(0, contacts.count), ContactExtremes<ContactTerms<Law>>{terms},
                            Kokkos::Max<Real>(report.highest_overlap_ratio), Kokkos::Max<Real>(report.stiffness));
    report.highest_overlap_ratio = Kokkos::fmax(report.highest_overlap_ratio, Real(0));
    return report;
}

} // namespace arenite
