message(STATUS "arenite ${PROJECT_VERSION}: ${CMAKE_BUILD_TYPE}, Kokkos ${Kokkos_VERSION} [${Kokkos_DEVICES}]")
