// SPDX-License-Identifier: MIT
// What Kokkos' Views hold, by their labels: counted from Kokkos' own announcements of allocations, so that nothing is
// forgotten and a change of layout needs no change here.
#pragma once

#include <map>
#include <string>

namespace arenite {

/// Counts allocations of the default memory space between its construction and its destruction; one at a time.
class ViewMemory {
public:
    ViewMemory();
    ~ViewMemory();
    ViewMemory(ViewMemory const&) = delete;
    ViewMemory& operator=(ViewMemory const&) = delete;

    /// Bytes of the Views that live now, by label.
    static std::map<std::string, double> by_label();

    static double peak(); // most bytes at any time: the lists being rebuilt beside the old ones
};

} // namespace arenite
