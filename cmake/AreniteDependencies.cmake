# What arenite is built from. An installed package wins (a cluster's own Kokkos, the system's fmt); what is
# not installed comes from the sources in ARENITE_DEPS_DIR, which cmake/fetch_deps.sh fills on a machine
# with a network and which can then be copied to one without. What neither holds is collected, so that
# one message names all of it. Optional parts (MPI, HDF5, VTK) are AreniteOutputParts' business.

set(arenite_missing "")      # one line per missing package, for the message at the end
set(arenite_missing_apt "")  # their Debian names
set(arenite_sources_used "") # what is built from ARENITE_DEPS_DIR, for the summary

macro(arenite_report_missing name debian_package variable)
  list(APPEND arenite_missing "${name} - where it is installed, set ${variable}")
  list(APPEND arenite_missing_apt ${debian_package})
endmacro()

# arenite_header_library(TARGET PACKAGE HEADER DEBIAN_PACKAGE [DEFINITION...]): the package's own CMake
# target, or one made here from its headers, with DEFINITIONs that say that there is no compiled part.
macro(arenite_header_library target package header debian_package)
  find_package(${package} CONFIG QUIET)
  if(NOT TARGET ${target})
    find_path(ARENITE_${package}_INCLUDE_DIR ${header} PATHS ${ARENITE_DEPS_DIR}/include)
    mark_as_advanced(ARENITE_${package}_INCLUDE_DIR)
    if(ARENITE_${package}_INCLUDE_DIR)
      add_library(${target} INTERFACE IMPORTED)
      target_include_directories(${target} INTERFACE ${ARENITE_${package}_INCLUDE_DIR})
      target_compile_definitions(${target} INTERFACE ${ARGN})
      if(ARENITE_${package}_INCLUDE_DIR STREQUAL "${ARENITE_DEPS_DIR}/include")
        list(APPEND arenite_sources_used ${package})
      endif()
    else()
      arenite_report_missing(${package} ${debian_package} "-D${package}_ROOT=<its prefix>")
    endif()
  endif()
endmacro()

include(AreniteKokkos)

arenite_header_library(fmt::fmt fmt fmt/format.h libfmt-dev FMT_HEADER_ONLY=1)
arenite_header_library(tomlplusplus::tomlplusplus tomlplusplus toml++/toml.h libtomlplusplus-dev)
arenite_header_library(CLI11::CLI11 CLI11 CLI/CLI.hpp libcli11-dev)
arenite_header_library(nlohmann_json::nlohmann_json nlohmann_json nlohmann/json.hpp nlohmann-json3-dev)

find_package(Threads REQUIRED)
if(ARENITE_ENABLE_TESTS)
  find_package(GTest QUIET)
  if(NOT TARGET GTest::gtest AND EXISTS ${ARENITE_DEPS_DIR}/googletest/src/gtest-all.cc)
    add_library(arenite_googletest STATIC EXCLUDE_FROM_ALL ${ARENITE_DEPS_DIR}/googletest/src/gtest-all.cc)
    target_include_directories(arenite_googletest PRIVATE ${ARENITE_DEPS_DIR}/googletest)
    target_include_directories(arenite_googletest SYSTEM PUBLIC ${ARENITE_DEPS_DIR}/googletest/include)
    target_link_libraries(arenite_googletest PUBLIC Threads::Threads)
    add_library(GTest::gtest ALIAS arenite_googletest)
    list(APPEND arenite_sources_used GoogleTest)
  endif()
  if(NOT TARGET GTest::gtest)
    arenite_report_missing(GoogleTest libgtest-dev "-DGTest_ROOT=<its prefix>, or -DARENITE_ENABLE_TESTS=OFF")
  endif()
endif()
if(ARENITE_ENABLE_PERF)
  find_package(benchmark QUIET PATHS ${ARENITE_DEPS_DIR}/benchmark)
  if(NOT TARGET benchmark::benchmark)
    arenite_report_missing("Google Benchmark" libbenchmark-dev
      "-Dbenchmark_ROOT=<its prefix>, or -DARENITE_ENABLE_PERF=OFF")
  endif()
endif()

if(arenite_missing)
  list(JOIN arenite_missing "\n  " arenite_missing)
  list(JOIN arenite_missing_apt " " arenite_missing_apt)
  if(arenite_missing_apt)
    set(arenite_apt_hint "On Debian or Ubuntu:\n  apt-get install ${arenite_missing_apt}\n")
  endif()
  message(FATAL_ERROR "arenite misses:\n  ${arenite_missing}\n${arenite_apt_hint}"
    "Sources in ${ARENITE_DEPS_DIR} are used where nothing is installed:\n"
    "  cmake/fetch_deps.sh           Kokkos and Kokkos Kernels\n"
    "  cmake/fetch_deps.sh --all     everything, for a machine that has no network\n")
endif()
