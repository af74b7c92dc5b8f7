// SPDX-License-Identifier: MIT
#include "fluid/coupled_set.hpp"

#include "core/random.hpp"
#include "core/work_array.hpp"

#include <Kokkos_Sort.hpp>

namespace arenite {
namespace {

View1<GrainId> sorted_ids(CoupledSet const& set)
{
    View1<GrainId> sorted(uninitialized("sorted_ids"), set.count);
    Kokkos::deep_copy(sorted, rows_of(set.id, 0, set.count));
    if (set.count > 1) Kokkos::sort(ExecutionSpace(), sorted);
    return sorted;
}

KOKKOS_FUNCTION bool contains(View1<GrainId> const& sorted, GrainId id)
{
    std::size_t first = 0, last = sorted.extent(0);
    while (first < last) {
        std::size_t const middle = (first + last) / 2;
        if (sorted(middle) < id) first = middle + 1;
        else last = middle;
    }
    return first < sorted.extent(0) && sorted(first) == id;
}

} // namespace

CoupledSet coupled_set(GrainWeights const& weights, Particles const& particles, CoupledSet const& storage)
{
    CoupledSet set = storage;
    set.count = weights.entries;
    fit(set.id, "coupled_id", set.count);
    fit(set.position, "coupled_position", set.count);
    auto const row = weights.bins.item;
    auto const id = particles.id;
    auto const position = particles.position;
    std::uint64_t digest = 0;
    Kokkos::parallel_reduce(
        "coupled_set", RangePolicy(0, set.count),
        KOKKOS_LAMBDA(int entry, std::uint64_t& sum) {
            int const later = weights.later_row(entry);
            prefetch(&position(later, 0));
            prefetch(&id(later));
            set.id(entry) = id(row(entry));
            store_record(load_record(&position(row(entry), 0)), &set.position(entry, 0));
            sum += mix_bits(set.id(entry));
        },
        digest);
    set.digest = digest;
    return set;
}

CoupledSet difference(CoupledSet const& a, CoupledSet const& b)
{
    View1<GrainId> const other = sorted_ids(b);
    CoupledSet rest;
    rest.id = View1<GrainId>("difference_id", a.count);
    rest.position = RecordView("difference_position", a.count);
    Kokkos::parallel_scan(
        "difference", RangePolicy(0, a.count),
        KOKKOS_LAMBDA(int entry, int& offset, bool last) {
            bool const missing = !contains(other, a.id(entry));
            if (last && missing) {
                rest.id(offset) = a.id(entry);
                for (int c = 0; c < 4; ++c) rest.position(offset, c) = a.position(entry, c);
            }
            offset += missing ? 1 : 0;
        },
        rest.count);
    return rest;
}

} // namespace arenite
