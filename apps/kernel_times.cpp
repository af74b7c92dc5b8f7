// SPDX-License-Identifier: MIT
#include "apps/kernel_times.hpp"

#include "apps/seconds_of.hpp"
#include "core/error.hpp"

#include <Kokkos_Core.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <vector>

namespace arenite {
namespace {

namespace Tools = Kokkos::Tools::Experimental;
using Now = std::chrono::steady_clock;

struct Row {
    long long calls = 0;
    double seconds = 0;
};
using Table = std::map<std::string, Row>;

/// Events nest: a sort runs kernels within a kernel's label, a phase holds everything. One thread launches them all.
struct Listener {
    struct Open {
        Row* row;
        Now::time_point begin;
    };
    Now::time_point begin;
    Table phases, kernels;
    std::vector<Open> open;
};
Listener listener; // Kokkos' callbacks are plain functions

void enter(Table& table, std::string const& name) { listener.open.push_back({&table[name], Now::now()}); }

void leave()
{
    if (listener.open.empty()) return; // it began before the listener did
    Listener::Open const event = listener.open.back();
    listener.open.pop_back();
    ++event.row->calls;
    event.row->seconds += seconds_since(event.begin);
}

void begin_kernel(char const* name, std::uint32_t, std::uint64_t*) { enter(listener.kernels, name); }
void end_kernel(std::uint64_t) { leave(); }
void begin_phase(char const* name) { enter(listener.phases, name); }
void begin_copy(Kokkos::Tools::SpaceHandle, char const* to, void const*, Kokkos::Tools::SpaceHandle, char const*,
                void const*, std::uint64_t)
{
    enter(listener.kernels, std::string("copy to ") + to);
}

Tools::EventSet callbacks()
{
    Tools::EventSet set{};
    set.begin_parallel_for = set.begin_parallel_reduce = set.begin_parallel_scan = begin_kernel;
    set.end_parallel_for = set.end_parallel_reduce = set.end_parallel_scan = end_kernel;
    set.push_region = begin_phase;
    set.pop_region = leave;
    set.begin_deep_copy = begin_copy;
    set.end_deep_copy = leave;
    return set;
}

std::string print(Table const& table, char const* title, double total)
{
    std::vector<std::pair<std::string, Row>> rows(table.begin(), table.end());
    std::stable_sort(rows.begin(), rows.end(),
                     [](auto const& a, auto const& b) { return a.second.seconds > b.second.seconds; });
    std::string text = fmt::format("{:<48} {:>10} {:>12} {:>8}\n", title, "calls", "seconds", "share");
    for (auto const& [name, row] : rows)
        text +=
            fmt::format("{:<48.48} {:>10} {:>12.6f} {:>6.2f} %\n", name, row.calls, row.seconds, 100 * row.seconds / total);
    return text;
}

} // namespace

void start_kernel_times()
{
    if (Kokkos::Tools::profileLibraryLoaded())
        throw InputError("--kernel-times: another tool listens to the kernels already (KOKKOS_TOOLS_LIBS)");
    listener = {};
    listener.begin = Now::now();
    Tools::set_callbacks(callbacks());
}

std::string finish_kernel_times()
{
    double const total = seconds_since(listener.begin);
    Tools::set_callbacks({});
    return fmt::format("{}\n{}", print(listener.phases, "phase", total), print(listener.kernels, "kernel or copy", total));
}

} // namespace arenite
