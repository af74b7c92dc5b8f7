// SPDX-License-Identifier: MIT
// With apps/large_pages.cpp in the program, large Views have the kernel's flag for large pages and small ones do not.
#include "core/types.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace arenite {
namespace {

/// Whether the mapping that holds the address asks for large pages (flag hg of /proc/self/smaps).
bool asks_for_large_pages(void const* address)
{
    auto const wanted = reinterpret_cast<std::uintptr_t>(address);
    std::ifstream maps("/proc/self/smaps");
    bool inside = false;
    for (std::string line; std::getline(maps, line);) {
        std::uintptr_t begin = 0, end = 0;
        char dash = 0;
        if (std::istringstream(line) >> std::hex >> begin >> dash >> end && dash == '-')
            inside = begin <= wanted && wanted < end;
        else if (inside && line.starts_with("VmFlags:")) return line.find(" hg") != std::string::npos;
    }
    return false;
}

TEST(LargePages, AreAskedForWhereAnArrayIsLarge)
{
    if (!std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled")) GTEST_SKIP() << "this system has no large pages";
    Kokkos::View<double*, HostSpace> const big("big", 64 << 17), small("small", 1 << 10); // 64 MiB and 8 kiB
    EXPECT_TRUE(asks_for_large_pages(big.data() + big.size() / 2));
    EXPECT_FALSE(asks_for_large_pages(small.data()));
}

TEST(LargePages, MoreMemoryThanThereIsGivesNone)
{
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer ends a program that asks for so much";
#endif
    EXPECT_THROW((Kokkos::View<double*, HostSpace>("too big", std::size_t(1) << 58)), std::exception);
}

} // namespace
} // namespace arenite
