// SPDX-License-Identifier: MIT
// Sums whose bits do not depend on the number of threads: the terms are cut into parts of a fixed size, each part is summed
// in a fixed order, and the sums of the parts are added in order. A floating-point parallel_reduce joins per-thread partials
// instead and so repeats for one thread count only. On a host a part is a chunk that one work item goes through; on a device
// it is a block of terms that a team of fixed size sums, since a few thousand terms must occupy more than a few threads.
#pragma once

#include "core/lanes.hpp"
#include "core/turns.hpp"

#include <type_traits>
#include <utility>

namespace arenite {

template <int N> using Terms = Kokkos::Array<Real, N>;

/// The same of as many items as there are lanes. (A third kind is any struct with += and numbers(), the N numbers of a sum
/// of such terms: what numbers() does is done once a chunk.)
template <int N> using LaneTerms = Kokkos::Array<Lanes, N>;

/// Scratch of the sums, reused so that a sum in a time loop does not allocate.
struct SumWorkspace {
    View1<Real> partial;                    // [part * N + which]
    Kokkos::View<Real*, PinnedSpace> total; // [which], written by a device
};

namespace reproducible {

// All of them are part of the result's definition.
constexpr int chunk = 256;                  // terms
constexpr int lanes = 4;                    // independent running sums in a chunk, to hide the latency of an addition
constexpr int team = 256, block = 4 * team; // threads, and terms that they sum

inline int part_count(int terms) { return on_host ? (terms + chunk - 1) / chunk : (terms + block - 1) / block; }

template <class Values> KOKKOS_FORCEINLINE_FUNCTION void add(Values const& values, Values& sum) { sum += values; }
template <class T, std::size_t N>
KOKKOS_FORCEINLINE_FUNCTION void add(Kokkos::Array<T, N> const& values, Kokkos::Array<T, N>& sum)
{
    for (std::size_t n = 0; n < N; ++n) sum[n] += values[n];
}

template <class Values> KOKKOS_FORCEINLINE_FUNCTION auto numbers_of(Values const& sum) { return sum.numbers(); }
template <class T, std::size_t N>
KOKKOS_FORCEINLINE_FUNCTION Terms<static_cast<int>(N)> numbers_of(Kokkos::Array<T, N> const& sum)
{
    Terms<static_cast<int>(N)> numbers{};
    for (std::size_t n = 0; n < N; ++n) numbers[n] = sum_of_lanes(sum[n]);
    return numbers;
}

// Kernels in headers are structs, not lambdas: nvcc keeps part of an extended lambda's type to each source file, and a
// function that several of them share would call what another one made.
template <int N, class Term> struct ChunkSum {
    Term term;
    int terms;
    View1<Real> partial;

    using Values = std::decay_t<decltype(std::declval<Term const&>()(0))>;
    // Vectors are sums side by side by themselves, and there are not registers for more.
    static constexpr int lanes = std::is_same_v<Values, Terms<N>> ? reproducible::lanes : 1;

    KOKKOS_FUNCTION void operator()(int c) const
    {
        Values sum[lanes] = {};
        for (int which = 0; which < chunk; which += lanes) {
            for (int lane = 0; lane < lanes; ++lane) {
                int const i = c * chunk + which + lane;
                if (i >= terms) continue;
                add(term(i), sum[lane]);
            }
        }
        if constexpr (lanes == 4)
            for (int n = 0; n < N; ++n) partial(c * N + n) = (sum[0][n] + sum[1][n]) + (sum[2][n] + sum[3][n]);
        else {
            Terms<N> const numbers = numbers_of(sum[0]);
            for (int n = 0; n < N; ++n) partial(c * N + n) = numbers[n];
        }
    }
};

/// A team sums `span` terms.
template <int N, class Term> struct BlockSum {
    Term term;
    int terms, span;
    Real* partial;

    KOKKOS_FUNCTION void operator()(TeamPolicy::member_type const& member) const
    {
        int const part = member.league_rank(), end = Kokkos::min(terms, (part + 1) * span);
        Real sum[N] = {};
        for (int i = part * span + member.team_rank(); i < end; i += team) {
            Terms<N> const value = numbers_of(term(i));
            for (int n = 0; n < N; ++n) sum[n] += value[n];
        }
        for (int n = 0; n < N; ++n) {
            member.team_reduce(Kokkos::Sum<Real>(sum[n]));
            if (member.team_rank() == 0) partial[part * N + n] = sum[n];
        }
    }
};

template <int N, class Term> void sum_chunks(char const* label, int terms, View1<Real> const& partial, Term const& term)
{
    for_each_turn(label, part_count(terms), ChunkSum<N, Term>{term, terms, partial});
}

template <int N, class Term> void sum_blocks(char const* label, int terms, int span, Real* partial, Term const& term)
{
    int const blocks = terms > 0 ? (terms + span - 1) / span : 1; // the sum of no terms is written too
    Kokkos::parallel_for(label, TeamPolicy(blocks, team), BlockSum<N, Term>{term, terms, span, partial});
}

template <int N> struct PartialTerm { // the sum of a part as a term of the next round
    View1<Real> partial;
    KOKKOS_FUNCTION Terms<N> operator()(int i) const
    {
        Terms<N> value{};
        for (int n = 0; n < N; ++n) value[n] = partial(i * N + n);
        return value;
    }
};

template <int N> void reserve(SumWorkspace& workspace, int parts)
{
    if (workspace.partial.extent_int(0) < parts * N)
        workspace.partial = View1<Real>(uninitialized("sum_partial"), parts * N);
    if (!on_host && workspace.total.extent_int(0) < N)
        workspace.total = Kokkos::View<Real*, PinnedSpace>(uninitialized("sum_total"), N);
}

struct Products {
    View1<Real> a, b;
    KOKKOS_FUNCTION Terms<1> operator()(int i) const { return {a(i) * b(i)}; }
};
struct Entries {
    View1<Real> a;
    KOKKOS_FUNCTION Terms<1> operator()(int i) const { return {a(i)}; }
};

} // namespace reproducible

/// N sums at once over i = 0 .. count - 1 of term(i), a device functor that returns Terms<N> or LaneTerms<N> or
/// what has numbers(), and may write what belongs to i. They go to `to`, memory that both the device and, on a host, the
/// caller can reach; nobody waits for a device.
template <int N, class Term>
void reproducible_sums_to(Real* to, SumWorkspace& workspace, char const* label, int count, Term const& term)
{
    int const parts = reproducible::part_count(count);
    reproducible::reserve<N>(workspace, parts);
    if constexpr (on_host) {
        reproducible::sum_chunks<N>(label, count, workspace.partial, term); // over when it returns
        for (int n = 0; n < N; ++n) to[n] = 0;
        for (int c = 0; c < parts; ++c)
            for (int n = 0; n < N; ++n) to[n] += workspace.partial(c * N + n);
    } else {
        reproducible::sum_blocks<N>(label, count, reproducible::block, parts > 1 ? workspace.partial.data() : to, term);
        if (parts > 1) reproducible::sum_blocks<N>(label, parts, parts, to, reproducible::PartialTerm<N>{workspace.partial});
    }
}

/// The same, on the host when it returns: one synchronisation.
template <int N, class Term>
Terms<N> reproducible_sums(SumWorkspace& workspace, char const* label, int count, Term const& term)
{
    Terms<N> total{};
    if (count <= 0) return total;
    reproducible::reserve<N>(workspace, reproducible::part_count(count));
    Real* const to = on_host ? &total[0] : workspace.total.data();
    reproducible_sums_to<N>(to, workspace, label, count, term);
    ExecutionSpace().fence(label);
    if constexpr (!on_host)
        for (int n = 0; n < N; ++n) total[n] = to[n];
    return total;
}

/// Dot product of two vectors of equal length.
inline Real reproducible_dot(SumWorkspace& workspace, View1<Real> const& a, View1<Real> const& b)
{
    return reproducible_sums<1>(workspace, "reproducible_dot", a.extent_int(0), reproducible::Products{a, b})[0];
}

/// The same to where reproducible_sums_to puts it.
inline void reproducible_dot_to(Real* to, SumWorkspace& workspace, View1<Real> const& a, View1<Real> const& b)
{
    reproducible_sums_to<1>(to, workspace, "reproducible_dot", a.extent_int(0), reproducible::Products{a, b});
}

inline Real reproducible_sum(SumWorkspace& workspace, View1<Real> const& a)
{
    return reproducible_sums<1>(workspace, "reproducible_sum", a.extent_int(0), reproducible::Entries{a})[0];
}

} // namespace arenite
