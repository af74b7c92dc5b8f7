// SPDX-License-Identifier: MIT
// The Kokkos spaces and the View aliases that everything that computes is written in.
// This is the only file that names a Kokkos space.
#pragma once

#include "core/real.hpp"

#include <Kokkos_Core.hpp>
#include <Kokkos_Profiling_ScopedRegion.hpp>

#include <string>

namespace arenite {

using ExecutionSpace = Kokkos::DefaultExecutionSpace;
using MemorySpace = ExecutionSpace::memory_space;
using HostSpace = Kokkos::HostSpace;
using PinnedSpace = Kokkos::SharedHostPinnedSpace; // the host's memory, which the device can write

/// What a kernel needs travels as its arguments (up to 4 kB). Without the hint Kokkos puts more than 512 bytes into CUDA's
/// constant memory, and then the host waits there until the kernel before has ended.
using RangePolicy =
    Kokkos::RangePolicy<ExecutionSpace, Kokkos::IndexType<int>, Kokkos::Experimental::WorkItemProperty::HintLightWeight_t>;
using TeamPolicy =
    Kokkos::TeamPolicy<ExecutionSpace, Kokkos::IndexType<int>, Kokkos::Experimental::WorkItemProperty::HintLightWeight_t>;
/// The same with at most `threads` threads a block of a GPU, of which `blocks` fit on a multiprocessor: the compiler keeps
/// to the registers that leaves.
template <int threads, int blocks>
using BoundedRangePolicy = Kokkos::RangePolicy<ExecutionSpace, Kokkos::IndexType<int>, Kokkos::LaunchBounds<threads, blocks>,
                                               Kokkos::Experimental::WorkItemProperty::HintLightWeight_t>;
inline constexpr bool on_host = Kokkos::SpaceAccessibility<Kokkos::HostSpace, MemorySpace>::accessible;

template <class T> using View1 = Kokkos::View<T*, MemorySpace>;

/// [item][component]; one record of four reals is 32 bytes, a GPU memory sector and half a CPU cache
/// line, so that reading a neighbour costs one transaction. LayoutRight on every backend for that reason.
using RecordView = Kokkos::View<Real* [4], Kokkos::LayoutRight, MemorySpace>;

/// Grid field [i][j][k], i fastest on every backend.
using FieldView = Kokkos::View<Real***, Kokkos::LayoutLeft, MemorySpace>;

/// Allocation of a View whose every entry is written before it is read.
inline auto uninitialized(std::string const& label) { return Kokkos::view_alloc(label, Kokkos::WithoutInitializing); }

/// Rows begin .. end - 1 of a View of rank 1 or 2, in its memory.
template <class View> auto rows_of(View const& view, int begin, int end)
{
    if constexpr (View::rank == 1) return Kokkos::subview(view, Kokkos::make_pair(begin, end));
    else return Kokkos::subview(view, Kokkos::make_pair(begin, end), Kokkos::ALL);
}

/// A phase of the run, from here to the end of the block, for the profiler that is attached (Kokkos Tools). Without one it
/// is two comparisons with a null pointer.
using Phase = Kokkos::Profiling::ScopedRegion;

/// Asks for the cache line at `address` ahead of its use; a GPU hides the wait with other threads. The address need not be
/// valid.
KOKKOS_FORCEINLINE_FUNCTION void prefetch([[maybe_unused]] void const* address)
{
    KOKKOS_IF_ON_HOST((__builtin_prefetch(address);))
}

} // namespace arenite
