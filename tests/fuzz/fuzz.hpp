// SPDX-License-Identifier: MIT
// What the fuzz targets share. Each target is one function with libFuzzer's signature: clang links it with libFuzzer
// (preset fuzz), AFL++ finds it too, and other compilers get tests/fuzz/driver.cpp. A target lets InputError pass, since
// that is what bad input is for, and nothing else: any other exception, a failed check, a sanitizer's report, a hang or
// a huge allocation ends the process and leaves the input behind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size);

/// What a reader has accepted must keep what it promises.
#define FUZZ_REQUIRE(condition)                                                                                             \
    do {                                                                                                                    \
        if (!(condition)) {                                                                                                 \
            std::fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #condition);                             \
            std::abort();                                                                                                   \
        }                                                                                                                   \
    } while (false)
