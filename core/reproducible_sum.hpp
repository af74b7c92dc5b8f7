// SPDX-License-Identifier: MIT
// Sums whose bits do not depend on the number of threads: the terms are cut into chunks of a fixed size,
// each chunk is summed in order by one work item, and the chunk sums are added in order. A floating-point
// parallel_reduce joins per-thread partials instead and so repeats for one thread count only.
#pragma once

#include "core/types.hpp"

#include <type_traits>
#include <utility>

namespace arenite
{

template <int N> using Terms = Kokkos::Array<Real, N>;

/// Scratch of the sums, reused so that a sum in a time loop does not allocate.
struct SumWorkspace {
    View1<Real> partial, next; // [chunk * N + which]
};

namespace reproducible
{

constexpr int chunk = 256; // terms; part of the result's definition
constexpr int lanes = 4;   // independent running sums in a chunk, to hide the latency of an addition
constexpr bool on_host = Kokkos::SpaceAccessibility<HostSpace, MemorySpace>::accessible;

inline int chunk_count(int terms) { return (terms + chunk - 1) / chunk; }

/// Term number `which` of chunk c: neighbours in memory on a host, neighbouring work items on a device.
KOKKOS_INLINE_FUNCTION int term_index(int c, int which, int chunks)
{
    if constexpr (on_host) return c * chunk + which;
    else return which * chunks + c;
}

template <int N, class Term> void sum_chunks(char const* label, int terms, View1<Real> partial, Term const& term)
{
    int const chunks = chunk_count(terms);
    Kokkos::parallel_for(
        label, RangePolicy(0, chunks), KOKKOS_LAMBDA(int c) {
            Real sum[lanes][N] = {};
            for (int which = 0; which < chunk; which += lanes) {
                for (int lane = 0; lane < lanes; ++lane) {
                    int const i = term_index(c, which + lane, chunks);
                    if (i >= terms) continue;
                    Terms<N> const value = term(i);
                    for (int n = 0; n < N; ++n) sum[lane][n] += value[n];
                }
            }
            for (int n = 0; n < N; ++n) partial(c * N + n) = (sum[0][n] + sum[1][n]) + (sum[2][n] + sum[3][n]);
        });
}

template <int N> struct PartialTerm { // a chunk sum as a term of the next round
    View1<Real> partial;
    KOKKOS_FUNCTION Terms<N> operator()(int i) const
    {
        Terms<N> value{};
        for (int n = 0; n < N; ++n) value[n] = partial(i * N + n);
        return value;
    }
};

inline void reserve(SumWorkspace& workspace, int size)
{
    if (workspace.partial.extent_int(0) >= size) return;
    workspace.partial = View1<Real>("sum_partial", size);
    workspace.next = View1<Real>("sum_next", size);
}

} // namespace reproducible

/// N sums at once over i = 0 .. count - 1 of term(i), a device functor that returns Terms<N>. On the host
/// when it returns: one synchronisation and, on a device, one copy of N numbers.
template <int N, class Term>
Terms<N> reproducible_sums(SumWorkspace& workspace, char const* label, int count, Term const& term)
{
    Terms<N> total{};
    if (count <= 0) return total;
    int chunks = reproducible::chunk_count(count);
    reproducible::reserve(workspace, chunks * N);
    reproducible::sum_chunks<N>(label, count, workspace.partial, term);
    if constexpr (reproducible::on_host) {
        ExecutionSpace().fence(label);
        for (int c = 0; c < chunks; ++c)
            for (int n = 0; n < N; ++n) total[n] += workspace.partial(c * N + n);
    } else {
        while (chunks > 1) {
            reproducible::sum_chunks<N>(label, chunks, workspace.next, reproducible::PartialTerm<N>{workspace.partial});
            std::swap(workspace.partial, workspace.next);
            chunks = reproducible::chunk_count(chunks);
        }
        Kokkos::View<Real*, HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>> result(total.data(), N);
        Kokkos::deep_copy(result, Kokkos::subview(workspace.partial, std::make_pair(0, N)));
    }
    return total;
}

/// Dot product of two vectors of equal length.
inline Real reproducible_dot(SumWorkspace& workspace, View1<Real> const& a, View1<Real> const& b)
{
    return reproducible_sums<1>(
        workspace, "reproducible_dot", a.extent_int(0), KOKKOS_LAMBDA(int i) { return Terms<1>{a(i) * b(i)}; })[0];
}

inline Real reproducible_sum(SumWorkspace& workspace, View1<Real> const& a)
{
    return reproducible_sums<1>(
        workspace, "reproducible_sum", a.extent_int(0), KOKKOS_LAMBDA(int i) { return Terms<1>{a(i)}; })[0];
}

} // namespace arenite
