// SPDX-License-Identifier: MIT
// Large arrays ask the system for large pages. A step goes through all of them; with pages of 4 kB it spends a part of its
// time on where they lie in memory (perf/did_not_pay.md says where that gained and where not). Kokkos takes a host's memory
// by the aligned operator new, which a program may replace; a system without large pages gives ordinary ones.
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>

#if __has_include(<sys/mman.h>) && __has_include(<unistd.h>)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace {

constexpr std::size_t large = std::size_t(8) << 20; // B; below it there is nothing to gain

void ask_for_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t size)
{
#ifdef MADV_HUGEPAGE
    auto const page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE)), begin = reinterpret_cast<std::uintptr_t>(memory);
    std::uintptr_t const first = (begin + page - 1) / page * page, last = (begin + size) / page * page;
    madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE); // a wish: what it answers changes nothing
#endif
}

void* take(std::size_t size, std::align_val_t alignment) noexcept
{
    auto const step = static_cast<std::size_t>(alignment);
    if (size > std::numeric_limits<std::size_t>::max() - step) return nullptr;
    void* const memory = std::aligned_alloc(step, (size + step - 1) / step * step);
    if (memory && size >= large) ask_for_large_pages(memory, size);
    return memory;
}

} // namespace

void* operator new(std::size_t size, std::align_val_t alignment, std::nothrow_t const&) noexcept
{
    return take(size, alignment);
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
    if (void* const memory = take(size > 0 ? size : 1, alignment)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t, std::nothrow_t const&) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
