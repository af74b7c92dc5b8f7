# Kokkos and Kokkos Kernels: installed (4.5 or newer), or built in this tree from ARENITE_DEPS_DIR. The
# backends and the architecture are Kokkos' own cache variables (Kokkos_ENABLE_OPENMP, Kokkos_ENABLE_CUDA,
# Kokkos_ARCH_AMPERE80, ...); the presets set them. An installed Kokkos brings its own.

set(arenite_wanted_backends "")
foreach(backend OPENMP CUDA)
  if(Kokkos_ENABLE_${backend})
    list(APPEND arenite_wanted_backends ${backend})
  endif()
endforeach()

find_package(Kokkos 4.5 CONFIG QUIET)
if(Kokkos_FOUND)
  set(arenite_kokkos_origin ${Kokkos_DIR})
  foreach(backend ${arenite_wanted_backends})
    if(NOT backend IN_LIST Kokkos_DEVICES)
      message(FATAL_ERROR "The Kokkos in ${Kokkos_DIR} has no ${backend} backend (it has: ${Kokkos_DEVICES}). "
        "Name another with -DKokkos_ROOT=<prefix>, or build the one in ${ARENITE_DEPS_DIR} with "
        "-DCMAKE_DISABLE_FIND_PACKAGE_Kokkos=ON.")
    endif()
  endforeach()
  if(Kokkos_COMPILE_LANGUAGE STREQUAL CUDA) # else its own compiler launcher is in force
    include(AreniteCuda)
  endif()
elseif(EXISTS ${ARENITE_DEPS_DIR}/kokkos/CMakeLists.txt)
  set(arenite_kokkos_origin ${ARENITE_DEPS_DIR}/kokkos)
  list(APPEND arenite_sources_used Kokkos)
  if(Kokkos_ENABLE_CUDA)
    include(AreniteCuda)
  endif()
  set(arenite_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
  set(CMAKE_MESSAGE_LOG_LEVEL WARNING) # theirs is a hundred lines; our summary says what matters
  add_subdirectory(${ARENITE_DEPS_DIR}/kokkos ${PROJECT_BINARY_DIR}/deps/kokkos)
  set(CMAKE_MESSAGE_LOG_LEVEL "${arenite_log_level}")
  get_directory_property(Kokkos_VERSION DIRECTORY ${ARENITE_DEPS_DIR}/kokkos DEFINITION Kokkos_VERSION)
  get_directory_property(Kokkos_DEVICES DIRECTORY ${ARENITE_DEPS_DIR}/kokkos DEFINITION KOKKOS_ENABLED_DEVICES)
  get_directory_property(Kokkos_ARCH DIRECTORY ${ARENITE_DEPS_DIR}/kokkos DEFINITION KOKKOS_ENABLED_ARCH_LIST)
else()
  arenite_report_missing("Kokkos 4.5 or newer" "" "-DKokkos_ROOT=<its prefix>, or run cmake/fetch_deps.sh")
  return()
endif()

find_package(KokkosKernels 4.5 CONFIG QUIET)
if(KokkosKernels_FOUND)
  set(arenite_kokkos_kernels_origin ${KokkosKernels_DIR})
elseif(EXISTS ${ARENITE_DEPS_DIR}/kokkos-kernels/CMakeLists.txt)
  set(arenite_kokkos_kernels_origin ${ARENITE_DEPS_DIR}/kokkos-kernels)
  list(APPEND arenite_sources_used KokkosKernels)
  # Without the default instantiations only what we call is compiled, where we call it. The vendor
  # libraries would tie the build to one toolkit's cuSPARSE interface and serve nothing here.
  set(KokkosKernels_ADD_DEFAULT_ETI OFF CACHE BOOL "")
  set(KokkosKernels_ENABLE_ALL_COMPONENTS OFF CACHE BOOL "")
  set(KokkosKernels_ENABLE_COMPONENT_SPARSE ON CACHE BOOL "")
  set(KokkosKernels_ENABLE_COMPONENT_GRAPH ON CACHE BOOL "")
  set(KokkosKernels_ENABLE_SUPERNODAL_SPTRSV OFF CACHE BOOL "") # asks for instantiations we leave out
  foreach(library CUBLAS CUSPARSE CUSOLVER)
    set(KokkosKernels_ENABLE_TPL_${library} OFF CACHE BOOL "")
  endforeach()
  set(arenite_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
  set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
  add_subdirectory(${ARENITE_DEPS_DIR}/kokkos-kernels ${PROJECT_BINARY_DIR}/deps/kokkos-kernels)
  set(CMAKE_MESSAGE_LOG_LEVEL "${arenite_log_level}")
  get_directory_property(KokkosKernels_VERSION DIRECTORY ${ARENITE_DEPS_DIR}/kokkos-kernels
    DEFINITION KokkosKernels_VERSION)
else()
  arenite_report_missing("Kokkos Kernels 4.5 or newer" ""
    "-DKokkosKernels_ROOT=<its prefix>, or run cmake/fetch_deps.sh")
endif()

# Our warnings are for our code: their headers are system headers to us.
foreach(target kokkoscore kokkoscontainers kokkosalgorithms kokkossimd kokkoskernels)
  if(TARGET ${target})
    get_target_property(includes ${target} INTERFACE_INCLUDE_DIRECTORIES)
    set_target_properties(${target} PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${includes}")
  endif()
endforeach()
