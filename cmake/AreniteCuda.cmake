# Kokkos on CUDA: the toolkit, the GPU architecture, and the few lines of a Kokkos built here that CUDA 13
# needs changed. CMake's own CUDA language compiles our sources and Kokkos' (not nvcc_wrapper, which reads
# every file twice and breaks on paths with spaces), and the host compiler links.

set(Kokkos_ENABLE_COMPILE_AS_CMAKE_LANGUAGE ON CACHE BOOL "" FORCE)
set(Kokkos_COMPILE_LANGUAGE CUDA)

find_package(CUDAToolkit QUIET) # knows where toolkits are put, also when nvcc is not in PATH
if(NOT CUDAToolkit_FOUND)
  message(FATAL_ERROR "Kokkos_ENABLE_CUDA is ON and there is no CUDA toolkit: put nvcc in PATH, or set "
    "-DCUDAToolkit_ROOT=<its prefix>.")
endif()
if(NOT CMAKE_CUDA_COMPILER AND NOT DEFINED ENV{CUDACXX})
  set(CMAKE_CUDA_COMPILER ${CUDAToolkit_NVCC_EXECUTABLE} CACHE FILEPATH "")
endif()
if(NOT CMAKE_CUDA_HOST_COMPILER AND NOT DEFINED ENV{CUDAHOSTCXX})
  set(CMAKE_CUDA_HOST_COMPILER ${CMAKE_CXX_COMPILER} CACHE FILEPATH "") # one compiler for all host code
endif()

# The architecture: as named, else Hopper. Kokkos would ask the GPU, and where we build there may be none.
# An installed Kokkos has said which it was built for.
get_cmake_property(variables CACHE_VARIABLES)
if(NOT Kokkos_FOUND)
  set(Kokkos_CUDA_ARCHITECTURES "")
else()
  set(variables "")
endif()
foreach(variable ${variables})
  if(variable MATCHES "^Kokkos_ARCH_(VOLTA|TURING|AMPERE|ADA|HOPPER|BLACKWELL)([0-9]+)$" AND ${variable})
    list(APPEND Kokkos_CUDA_ARCHITECTURES ${CMAKE_MATCH_2})
  endif()
endforeach()
if(NOT Kokkos_CUDA_ARCHITECTURES)
  set(Kokkos_ARCH_HOPPER90 ON CACHE BOOL "" FORCE)
  set(Kokkos_CUDA_ARCHITECTURES 90)
endif()

set(CMAKE_CUDA_ARCHITECTURES ${Kokkos_CUDA_ARCHITECTURES})
enable_language(CUDA)
set(CMAKE_CUDA_STANDARD 20)
set(CMAKE_CUDA_STANDARD_REQUIRED ON)
set(CMAKE_CUDA_EXTENSIONS OFF)
if(NOT DEFINED CMAKE_CUDA20_STANDARD_COMPILE_OPTION) # CMake learned it in 3.25.2, nvcc in 12.0
  set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION "-std=c++20")
  set(CMAKE_CUDA20_EXTENSION_COMPILE_OPTION "-std=c++20")
endif()

# CUDA 13 changed the signatures of three runtime functions; Kokkos 4.7 and newer know. The new lines ask
# for the toolkit's version, so that sources patched once also build with an older one.
if(Kokkos_FOUND)
  return()
endif()
set(header ${ARENITE_DEPS_DIR}/kokkos/core/src/Cuda/Kokkos_Cuda_Instance.hpp)
file(STRINGS ${ARENITE_DEPS_DIR}/kokkos/CMakeLists.txt version_lines REGEX "set\\(Kokkos_VERSION_(MAJOR|MINOR) ")
string(REGEX REPLACE ".*MAJOR ([0-9]+).*MINOR ([0-9]+).*" "\\1.\\2" kokkos_source_version "${version_lines}")
if(CUDAToolkit_VERSION VERSION_GREATER_EQUAL 13 AND kokkos_source_version VERSION_LESS 4.7)
  file(READ ${header} text)
  string(FIND "${text}" "patched for CUDA 13 by arenite" already)
  if(already EQUAL -1)
    macro(arenite_replace old new)
      string(FIND "${text}" "${old}" position)
      if(position EQUAL -1)
        message(FATAL_ERROR "${header}: the line to change for CUDA 13 is not there: ${old}\n"
          "Empty ${ARENITE_DEPS_DIR} and run cmake/fetch_deps.sh again, or use CUDA 12.")
      endif()
      string(REPLACE "${old}" "#if CUDART_VERSION >= 13000\n${new}\n#else\n${old}\n#endif" text "${text}")
    endmacro()
    arenite_replace("    return cudaGraphAddDependencies(graph, from, to, numDependencies);"
      "    return cudaGraphAddDependencies(graph, from, to, nullptr, numDependencies);")
    set(location "    cudaMemLocation where{};
    where.type = DEVICE == cudaCpuDeviceId ? cudaMemLocationTypeHost : cudaMemLocationTypeDevice;
    where.id   = DEVICE == cudaCpuDeviceId ? 0 : DEVICE;")
    string(REPLACE DEVICE device location_of_advice "${location}")
    string(REPLACE DEVICE dstDevice location_of_prefetch "${location}")
    arenite_replace("    return cudaMemAdvise(devPtr, count, advice, device);"
      "${location_of_advice}\n    return cudaMemAdvise(devPtr, count, advice, where);")
    arenite_replace("    return cudaMemPrefetchAsync(devPtr, count, dstDevice,
                                get_input_stream(stream));"
      "${location_of_prefetch}\n    return cudaMemPrefetchAsync(devPtr, count, where, 0, get_input_stream(stream));")
    file(WRITE ${header} "// patched for CUDA 13 by arenite (cmake/AreniteCuda.cmake)\n${text}")
    message(STATUS "Kokkos ${kokkos_source_version}: patched for CUDA ${CUDAToolkit_VERSION}")
  endif()
endif()
