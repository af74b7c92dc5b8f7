// SPDX-License-Identifier: MIT
#include "apps/stop_signal.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace arenite {
namespace {

TEST(StopSignal, TheFirstAsksALaterOneEnds)
{
    for (int const signal : {SIGTERM, SIGINT}) {
        StopSignals const caught;
        EXPECT_EQ(stop_signal(), 0);
        std::raise(signal);
        std::raise(signal); // at once: the same request, as timeout(1) makes it
        EXPECT_EQ(stop_signal(), signal);
        std::this_thread::sleep_for(std::chrono::milliseconds(1100));
        EXPECT_EXIT(std::raise(SIGTERM), testing::KilledBySignal(SIGTERM), "");
        EXPECT_EXIT(std::raise(SIGINT), testing::KilledBySignal(SIGINT), "");
    }
}

TEST(StopSignal, OneThatIsIgnoredStaysIgnored)
{
    std::signal(SIGINT, SIG_IGN); // as nohup and a shell's background jobs do
    {
        StopSignals const caught;
        std::raise(SIGINT);
        EXPECT_EQ(stop_signal(), 0);
    }
    EXPECT_EQ(std::signal(SIGINT, SIG_DFL), SIG_IGN);
}

TEST(StopSignal, NothingIsCaughtAfterwards)
{
    {
        StopSignals const caught;
    }
    EXPECT_EXIT(std::raise(SIGTERM), testing::KilledBySignal(SIGTERM), "");
}

} // namespace
} // namespace arenite
