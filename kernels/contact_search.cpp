// SPDX-License-Identifier: MIT
#include "kernels/contact_search.hpp"

#include "core/error.hpp"
#include "core/work_array.hpp"
#include "kernels/contact_memory.hpp"
#include "kernels/find_pairs.hpp"

#include <utility>

namespace arenite {

void search_contacts(Particles& particles, PeriodicBox const& box, SearchSettings const& settings, ContactList& contacts)
{
    Phase const phase("contact search");
    OldContacts old{memory_of(contacts), particles.id, {}};
    RecordView records = contacts.reference_position;
    contacts = ContactList{};
    fit(records, "reference_position", particles.count);
    old.row = sort_grains(particles, box, settings, records);
    contacts.needs = settings.needs;
    contacts.periodic = box.any_periodic();
    contacts.reference_position = records;
    find_pairs(particles, box, settings, contacts);
    carry_memory(old, particles, contacts);
    make_force_rows(settings.forces_follow ? std::exchange(old.list.force, {}) : ForceRows{}, contacts);
    if (!settings.forces_follow) carry_forces(old, particles, contacts);
    old = {};
    make_scales(particles, contacts);
    make_incidence(particles, contacts);
}

void complete_list(Particles const& particles, ContactList& contacts)
{
    contacts.close = count_close(contacts);
    // As many rows beyond the last contact as the kernels of this program want.
    fit_memory(contacts);
    fit_forces(contacts);
    ContactList const list = contacts;
    Kokkos::parallel_for(
        "complete_list", RangePolicy(0, particles.count),
        KOKKOS_LAMBDA(int i) { for_each_owned(list, i, [&](int c) { list.first(c) = i; }); });
    make_scales(particles, contacts);
    make_incidence(particles, contacts);
}

int form_bonds(Particles const& particles, PeriodicBox const& box, ContactList const& contacts, PairTable const& pairs)
{
    ARENITE_REQUIRE(contacts.needs.bonds, "the contact list holds no bonds");
    ContactList const list = contacts;
    RecordView const position = particles.position;
    View1<std::uint8_t> const material = particles.material;
    int bonds = 0;
    Kokkos::parallel_reduce(
        "form_bonds", RangePolicy(0, contacts.count),
        KOKKOS_LAMBDA(int c, int& sum) {
            int const i = list.first(c), j = list.second(c);
            if (pairs(material(i), material(j)).bonds_at_start &&
                position(i, 3) + position(j, 3) - norm(contact_offset(list, position, box, c)) >= 0)
                list.adhering(c) = 1;
            sum += list.adhering(c);
        },
        bonds);
    return bonds;
}

void count_bonds(Particles const& particles, ContactList const& contacts, View1<int> const& bonds,
                 View1<int> const& coordination)
{
    ContactList const list = contacts;
    Kokkos::parallel_for(
        "count_bonds", RangePolicy(0, particles.count), KOKKOS_LAMBDA(int i) {
            int bonded = 0, touching = 0;
            for (int row = i; row < 2 * list.grains(); row += list.grains())
                for (int k = list.incident_begin(row); k < list.incident_begin(row + 1); ++k) {
                    int const c = list.incident(k) / 2;
                    touching += list.touching(c) ? 1 : 0;
                    if (list.needs.bonds) bonded += list.adhering(c) ? 1 : 0;
                }
            bonds(i) = bonded;
            coordination(i) = touching;
        });
}

} // namespace arenite
