// SPDX-License-Identifier: MIT
#include "apps/stop_signal.hpp"

#include <atomic>
#include <csignal>
#include <ctime>

namespace arenite {
namespace {

constexpr long one_request = 1000; // ms within which signals are the same one

std::atomic<int> received{0};
std::atomic<long> received_at{0}; // ms
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<long>::is_always_lock_free,
              "a signal handler may write them");

long now() // of what a signal handler may call
{
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return 1000 * static_cast<long>(time.tv_sec) + time.tv_nsec / 1'000'000;
}

extern "C" void on_stop_signal(int signal)
{
    if (received == 0) {
        received_at = now();
        received = signal;
    } else if (now() - received_at >= one_request) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

} // namespace

int stop_signal() { return received.load(std::memory_order_relaxed); }

StopSignals::StopSignals()
{
    received = 0;
    for (int const signal : {SIGINT, SIGTERM}) {
        struct sigaction old{};
        sigaction(signal, nullptr, &old);
        if (old.sa_handler == SIG_IGN) continue;
        struct sigaction action{};
        action.sa_handler = on_stop_signal;
        action.sa_flags = SA_RESTART; // a write goes on
        sigaction(signal, &action, nullptr);
    }
}

StopSignals::~StopSignals()
{
    for (int const signal : {SIGINT, SIGTERM}) {
        struct sigaction now{};
        sigaction(signal, nullptr, &now);
        if (now.sa_handler == on_stop_signal) std::signal(signal, SIG_DFL);
    }
}

} // namespace arenite
