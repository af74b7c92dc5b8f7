# Tests of the grains: contact laws, search, integrator. Pairs and small packs gain nothing from threads, so
# these run on one; the determinism tests set their own number.
arenite_test(test_grains unit unit/test_jkr.cpp unit/test_material.cpp unit/test_tangential.cpp unit/test_contact_forces.cpp
  unit/test_contact_passes.cpp unit/test_contact_search.cpp unit/test_integrate.cpp unit/test_verify.cpp LINK arenite_verify)
set_tests_properties(test_grains PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1;OMP_PROC_BIND=false")

arenite_test(test_core unit unit/test_lanes.cpp unit/test_large_pages.cpp ../apps/large_pages.cpp unit/test_turns.cpp
  unit/test_reproducible_sum.cpp) # on more threads than one
set_source_files_properties(../apps/large_pages.cpp PROPERTIES ARENITE_HOST_ONLY TRUE)

# What `arenite verify` runs, a ctest a group.
add_executable(verify_groups verification/verify_groups.cpp)
target_link_libraries(verify_groups PRIVATE arenite_test_main arenite_verify)
foreach(group Contact Friction Integrator Search Fluid Coupling CoarseGraining)
  add_test(NAME verify_${group} COMMAND verify_groups --gtest_filter=Verify.${group})
  set_tests_properties(verify_${group} PROPERTIES LABELS verification TIMEOUT 600
    ENVIRONMENT "OMP_NUM_THREADS=1;OMP_PROC_BIND=false")
endforeach()

add_executable(hash_pack determinism/hash_pack.cpp)
target_link_libraries(hash_pack PRIVATE arenite_verify)
foreach(box open periodic tiled)
  add_test(NAME threads_give_equal_bits_${box}
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:hash_pack> -D ARGUMENTS=${box}
      -P ${CMAKE_CURRENT_SOURCE_DIR}/determinism/compare_threads.cmake)
  set_tests_properties(threads_give_equal_bits_${box} PROPERTIES LABELS determinism TIMEOUT 300
    ENVIRONMENT "OMP_WAIT_POLICY=passive;OMP_PROC_BIND=false") # threads outnumber cores here and there
endforeach()
