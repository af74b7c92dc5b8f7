// SPDX-License-Identifier: MIT
#pragma once

#include "core/types.hpp"

#include <string>
#include <vector>

namespace arenite {

/// A device copy of plain data.
template <class T> View1<T> to_device(std::vector<T> const& values, std::string const& label)
{
    View1<T> const view(uninitialized(label), values.size());
    Kokkos::View<T const*, HostSpace, Kokkos::MemoryUnmanaged> const source(values.data(), values.size());
    Kokkos::deep_copy(view, source);
    return view;
}

} // namespace arenite
