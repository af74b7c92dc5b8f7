// SPDX-License-Identifier: MIT
#include "apps/stop_signal.hpp"

#include <atomic>
#include <csignal>

namespace arenite {
namespace {

std::atomic<int> received{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may write it");

void set_default()
{
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

extern "C" void on_stop_signal(int signal)
{
    received = signal;
    set_default();
}

} // namespace

int stop_signal() { return received.load(std::memory_order_relaxed); }

StopSignals::StopSignals()
{
    received = 0;
    for (int const signal : {SIGINT, SIGTERM}) {
        struct sigaction old {};
        sigaction(signal, nullptr, &old);
        if (old.sa_handler == SIG_IGN) continue;
        struct sigaction action {};
        action.sa_handler = on_stop_signal;
        action.sa_flags = SA_RESTART; // a write goes on
        sigaction(signal, &action, nullptr);
    }
}

StopSignals::~StopSignals()
{
    for (int const signal : {SIGINT, SIGTERM}) {
        struct sigaction now {};
        sigaction(signal, nullptr, &now);
        if (now.sa_handler == on_stop_signal) std::signal(signal, SIG_DFL);
    }
}

} // namespace arenite
