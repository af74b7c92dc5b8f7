// SPDX-License-Identifier: MIT
#include "kernels/contact_memory.hpp"

#include "kernels/contact_passes.hpp"

namespace arenite {
namespace {

/// An array of `length` rows. Those of contacts are what it had, else still to be written; those behind them are.
template <class View> void fit_contacts(ContactList const& contacts, View& view, char const* label, int length, int behind)
{
    View const before = view;
    view = View(uninitialized(label), length);
    Kokkos::deep_copy(rows_of(view, contacts.count, length), behind);
    if (before.is_allocated() && contacts.count > 0)
        Kokkos::deep_copy(rows_of(view, 0, contacts.count), rows_of(before, 0, contacts.count));
}

/// Rows of an array with one per contact.
int padded_count(ContactList const& contacts)
{
    return (contacts.count + contact_block - 1) / contact_block * contact_block;
}

/// Contacts' force rows and those that passes share.
int force_row_count(ContactList const& contacts)
{
    return padded_count(contacts) + shared_rows(contacts, ExecutionSpace().concurrency());
}

} // namespace

int count_close(ContactList const& list)
{
    int close = 0;
    Kokkos::deep_copy(close, Kokkos::subview(list.row_begin, list.close_sections() * list.grains()));
    return close;
}

void fit_memory(ContactList& contacts)
{
    int const n = padded_count(contacts);
    fit_contacts(contacts, contacts.first, "contact_first", n, 0);
    fit_contacts(contacts, contacts.second, "contact_second", n + second_ahead, 0);
    if (contacts.periodic) fit_contacts(contacts, contacts.image, "contact_image", n, PeriodicBox::image_code(0, 0, 0));
    fit_contacts(contacts, contacts.touching, "contact_touching", n, 0);
    if (contacts.needs.bonds) fit_contacts(contacts, contacts.adhering, "contact_adhering", n, 0);
    if (contacts.needs.history) fit_contacts(contacts, contacts.spring, "contact_spring", n, 0);
    if (contacts.needs.contact_radius) fit_contacts(contacts, contacts.contact_radius, "contact_radius", n, 0);
}

void fit_forces(ContactList& contacts)
{
    fit_contacts(contacts, contacts.force, "contact_force", force_row_count(contacts), 0);
}

void make_scales(Particles const& particles, ContactList& contacts)
{
    int const n = padded_count(contacts);
    fit_contacts(contacts, contacts.scale, "contact_scale", n, 1);
    if (contacts.needs.bonds) fit_contacts(contacts, contacts.inverse_cube_root, "contact_inverse_cube_root", n, 1);
    ContactList const list = contacts;
    RecordView const position = particles.position, velocity = particles.velocity;
    View1<Motion> const motion = particles.motion;
    Kokkos::parallel_for(
        "make_scales", RangePolicy(0, contacts.count), KOKKOS_LAMBDA(int c) {
            int const i = list.first(c), j = list.second(c);
            Real const ri = position(i, 3), rj = position(j, 3), mi = velocity(i, 3), mj = velocity(j, 3);
            Real const radius = ri * rj / (ri + rj);
            list.scale(c, 0) = radius;
            // A grain that no force moves takes part as a wall does, with any mass: then the restitution is the free one's.
            bool const i_moves = motion(i) == Motion::free, j_moves = motion(j) == Motion::free;
            list.scale(c, 1) = i_moves == j_moves ? mi * mj / (mi + mj) : i_moves ? mi : mj;
            if (list.needs.bonds) list.inverse_cube_root(c) = 1 / Kokkos::cbrt(radius);
        });
}

void make_incidence(Particles const& particles, ContactList& contacts)
{
    int const grains = particles.count;
    contacts.incident_begin = View1<int>(uninitialized("incident_begin"), 2 * grains + 1);
    contacts.incident = View1<int>("incident", 2 * contacts.count + incident_ahead);
    contacts.incident_place = View1<std::uint8_t>(uninitialized("incident_place"), 2 * (contacts.count - contacts.close));
    contacts.awake = View1<std::uint8_t>("contact_awake", grains);
    ContactList const list = contacts;
    View1<int> const left("incident_left", 2 * grains); // still to be filled in; a grain's others at grains + i
    Kokkos::parallel_for(
        "count_incident", RangePolicy(0, list.count), KOKKOS_LAMBDA(int c) {
            int const rows = c < list.close ? 0 : grains;
            Kokkos::atomic_inc(&left(rows + list.first(c)));
            Kokkos::atomic_inc(&left(rows + list.second(c)));
        });
    Kokkos::parallel_for(
        "join_incident", RangePolicy(0, grains), KOKKOS_LAMBDA(int i) {
            if (left(i) <= most_places) return;
            left(i) += left(grains + i);
            left(grains + i) = 0;
        });
    Kokkos::parallel_scan(
        "scan_incident", RangePolicy(0, 2 * grains + 1), KOKKOS_LAMBDA(int row, int& sum, bool last) {
            if (last) list.incident_begin(row) = sum;
            sum += row < 2 * grains ? left(row) : 0;
        });
    Kokkos::parallel_for(
        "fill_incident", RangePolicy(0, list.count), KOKKOS_LAMBDA(int c) {
            for (int side = 0; side < 2; ++side) {
                int const i = side ? list.second(c) : list.first(c);
                int row = c < list.close ? i : grains + i;
                if (list.incident_begin(row) == list.incident_begin(row + 1)) row = i; // joined
                list.incident(list.incident_begin(row) + Kokkos::atomic_fetch_sub(&left(row), 1) - 1) = 2 * c + side;
                if (c >= list.close && list.touching(c)) list.awake(i) = 1;
            }
        });
    View1<GrainId> const id = particles.id;
    Kokkos::parallel_for(
        "sort_incident", RangePolicy(0, grains), KOKKOS_LAMBDA(int i) {
            auto const partner = [&](int entry) { return id(entry & 1 ? list.first(entry / 2) : list.second(entry / 2)); };
            auto const sort = [&](int begin, int end) { // by insertion
                for (int k = begin + 1; k < end; ++k) {
                    int const entry = list.incident(k);
                    GrainId const key = partner(entry);
                    int slot = k;
                    for (; slot > begin && partner(list.incident(slot - 1)) > key; --slot)
                        list.incident(slot) = list.incident(slot - 1);
                    list.incident(slot) = entry;
                }
            };
            sort(list.incident_begin(i), list.incident_begin(i + 1));
            int const begin = list.incident_begin(grains + i), end = list.incident_begin(grains + i + 1);
            sort(begin, end);
            int const close_begin = list.incident_begin(i), close_end = list.incident_begin(i + 1);
            for (int k = begin, close = close_begin; k < end; ++k) {
                GrainId const key = partner(list.incident(k));
                while (close < close_end && partner(list.incident(close)) < key) ++close;
                list.incident_place(k - list.incident_begin(grains)) = static_cast<std::uint8_t>(close - close_begin);
            }
        });
}

ContactList memory_of(ContactList const& list)
{
    ContactList memory;
    memory.tile_grains = list.tile_grains;
    memory.needs = list.needs;
    memory.row_begin = list.row_begin;
    memory.second = list.second;
    memory.touching = list.touching;
    memory.adhering = list.adhering;
    memory.spring = list.spring;
    memory.contact_radius = list.contact_radius;
    memory.force = list.force;
    return memory;
}

void carry_memory(OldContacts const& old, Particles const& particles, ContactList const& contacts)
{
    ContactList const list = contacts;
    View1<GrainId> const id = particles.id;
    ContactNeeds const had = old.list.needs;
    Kokkos::parallel_for(
        "carry_memory", RangePolicy(0, contacts.count), KOKKOS_LAMBDA(int c) {
            int const from = old.find(list.first(c), id(list.second(c)));
            bool const known = from >= 0;
            list.touching(c) = known && old.list.touching(from) != 0;
            if (list.needs.bonds) list.adhering(c) = known && had.bonds ? old.list.adhering(from) : 0;
            if (list.needs.history)
                for (int n = 0; n < 3; ++n) list.spring(c, n) = known && had.history ? old.list.spring(from, n) : 0;
            if (list.needs.contact_radius)
                list.contact_radius(c) = known && had.contact_radius ? old.list.contact_radius(from) : 0;
        });
}

void make_force_rows(ForceRows spare, ContactList& contacts)
{
    int const rows = force_row_count(contacts);
    if (spare.extent_int(0) >= rows) contacts.force = rows_of(spare, 0, rows);
    spare = {};
    if (!contacts.force.is_allocated()) contacts.force = ForceRows(uninitialized("contact_force"), rows);
    ForceRows const force = contacts.force;
    Kokkos::parallel_for(
        "clear_forces", RangePolicy(0, rows), KOKKOS_LAMBDA(int row) {
            for (int n = 0; n < 8; ++n) force(row, n) = 0;
        });
}

void carry_forces(OldContacts const& old, Particles const& particles, ContactList const& contacts)
{
    ContactList const list = contacts;
    View1<GrainId> const id = particles.id;
    Kokkos::parallel_for(
        "carry_forces", RangePolicy(0, contacts.count), KOKKOS_LAMBDA(int c) {
            if (!list.touching(c)) return;
            int const from = old.find(list.first(c), id(list.second(c)));
            for (int n = 0; n < 8; ++n) list.force(c, n) = old.list.force(from, n);
        });
}

} // namespace arenite
