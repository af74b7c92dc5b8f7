# Reading Kokkos' headers is a third to a half of what compiling one of our sources takes: GCC reads them once, for all
# targets that link arenite_core. (nvcc does not reuse what it has read; see AreniteDeviceSources.cmake. The test
# headers_alone parses headers without this, and the debug preset the sources: one that forgets an include is found there.
# GCC 12 forgets that such headers are the system's, whose warnings it keeps to itself; so not where warnings are errors.)
option(ARENITE_PRECOMPILE_HEADERS "Read Kokkos' headers once for all sources (GCC)" ON)

function(arenite_precompile_headers target)
  if(NOT ARENITE_PRECOMPILE_HEADERS OR ARENITE_WARNINGS_AS_ERRORS OR Kokkos_COMPILE_LANGUAGE STREQUAL CUDA
      OR NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    return()
  endif()
  if(target STREQUAL arenite_core)
    target_precompile_headers(arenite_core PRIVATE
      <Kokkos_Core.hpp> <Kokkos_Profiling_ScopedRegion.hpp> <algorithm> <array> <functional> <map> <string> <vector>)
  else()
    target_precompile_headers(${target} REUSE_FROM arenite_core)
  endif()
endfunction()
