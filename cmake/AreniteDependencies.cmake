find_package(Kokkos 4.5 REQUIRED CONFIG)
find_package(KokkosKernels 4.5 REQUIRED CONFIG)
find_package(fmt REQUIRED)
