# The project's own switches. The backend (OpenMP, CUDA) is Kokkos' business: see CMakePresets.json.
option(ARENITE_ENABLE_TESTS "Build the test suite" ${PROJECT_IS_TOP_LEVEL})
option(ARENITE_ENABLE_PERF "Build the kernel benchmarks" OFF)
option(ARENITE_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)
set(ARENITE_SANITIZE "" CACHE STRING "Sanitizers for host code, for example address,undefined")
option(ARENITE_FUZZ "Build tests/fuzz with libFuzzer (clang only)" OFF)
foreach(part MPI HDF5 VTK)
  set(ARENITE_ENABLE_${part} "AUTO" CACHE STRING "Use ${part}: AUTO (if found), ON or OFF")
  set_property(CACHE ARENITE_ENABLE_${part} PROPERTY STRINGS AUTO ON OFF)
endforeach()
set(ARENITE_DEPS_DIR "${PROJECT_SOURCE_DIR}/deps" CACHE PATH
  "Sources of what is not installed, as cmake/fetch_deps.sh lays them")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON) # for clang-tidy, and for the test that compiles each header alone

# Flags of every target of ours. No contraction on the host: a fused multiply-add here and not there
# would make the bits depend on the compiler's mood (same bits for any thread count, across a restart).
# On the device fmad stays on: ptxas fuses the same way on every run of one binary, which is all that is
# promised ("same bits on the same backend"), and without it the contact kernels lose up to half of the
# FP64 rate.
set(arenite_host_flags -Wall -Wextra -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # Its own avx512fintrin.h sets it off at every use of a mask (GCC bug 105593).
  list(APPEND arenite_host_flags -Wno-uninitialized -Wno-maybe-uninitialized)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Vectors wider than the target's are passed between inline functions only (core/lanes.hpp).
  list(APPEND arenite_host_flags -Wno-psabi)
endif()
if(ARENITE_WARNINGS_AS_ERRORS)
  list(APPEND arenite_host_flags -Werror)
endif()
if(ARENITE_SANITIZE)
  list(APPEND arenite_host_flags -fno-omit-frame-pointer)
endif()
list(JOIN arenite_host_flags "," arenite_flags_through_nvcc)

# Sources of the contacts' kernels, what shares their terms, and the exchange with the fluid may fuse: one kernel evaluates a
# pair, whatever the step is for, so nothing has to round alike elsewhere, and it is bound by the length of its chains of
# multiplies and adds (12 % of its time).
function(arenite_fuse_multiply_add)
  set_source_files_properties(${ARGN} PROPERTIES
    COMPILE_OPTIONS "$<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=fast>"
    SKIP_PRECOMPILE_HEADERS ON) # those were read under other flags
endfunction()

add_library(arenite_flags INTERFACE)
target_include_directories(arenite_flags INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/arenite>)
target_compile_features(arenite_flags INTERFACE cxx_std_20)
# fmt takes nvcc for a compiler without constexpr, and then its format strings do not compile in C++20.
target_compile_definitions(arenite_flags INTERFACE FMT_USE_CONSTEXPR=1)
# nvcc has flags of the same spelling but another meaning, so what is meant for the host compiler goes
# through -Xcompiler.
target_compile_options(arenite_flags INTERFACE
  "$<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:${arenite_host_flags}>>"
  "$<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CUDA>:-Xcompiler=${arenite_flags_through_nvcc}>>")
if(ARENITE_SANITIZE)
  target_compile_options(arenite_flags INTERFACE
    $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-fsanitize=${ARENITE_SANITIZE}>>)
  target_link_options(arenite_flags INTERFACE $<BUILD_INTERFACE:-fsanitize=${ARENITE_SANITIZE}>)
endif()
if(ARENITE_FUZZ)
  target_compile_options(arenite_flags INTERFACE $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-fsanitize=fuzzer-no-link>>)
endif()
