// SPDX-License-Identifier: MIT
#include "apps/view_memory.hpp"

#include "core/types.hpp"

#include <algorithm>

namespace arenite {
namespace {

namespace Tools = Kokkos::Tools::Experimental;

struct Count {
    std::map<void const*, std::pair<std::string, double>> live; // by address
    double total = 0, peak = 0;
};
Count count; // Kokkos' callbacks are plain functions
Tools::EventSet callbacks_before;

bool is_ours(Kokkos::Tools::SpaceHandle const& space) { return std::string(space.name) == MemorySpace::name(); }

void allocated(Kokkos::Tools::SpaceHandle const space, char const* label, void const* address, std::uint64_t bytes)
{
    if (!is_ours(space)) return;
    count.live[address] = {label, static_cast<double>(bytes)};
    count.total += static_cast<double>(bytes);
    count.peak = std::max(count.peak, count.total);
}

void freed(Kokkos::Tools::SpaceHandle const space, char const*, void const* address, std::uint64_t)
{
    auto const found = count.live.find(address);
    if (!is_ours(space) || found == count.live.end()) return; // it was there before the count began
    count.total -= found->second.second;
    count.live.erase(found);
}

} // namespace

ViewMemory::ViewMemory()
{
    count = {};
    callbacks_before = Tools::get_callbacks();
    Tools::set_allocate_data_callback(allocated);
    Tools::set_deallocate_data_callback(freed);
}

ViewMemory::~ViewMemory()
{
    Tools::set_allocate_data_callback(callbacks_before.allocate_data);
    Tools::set_deallocate_data_callback(callbacks_before.deallocate_data);
}

std::map<std::string, double> ViewMemory::by_label()
{
    std::map<std::string, double> bytes;
    for (auto const& [address, entry] : count.live) bytes[entry.first] += entry.second;
    return bytes;
}

double ViewMemory::peak() { return count.peak; }

} // namespace arenite
