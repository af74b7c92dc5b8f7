# The fluid solver's tests. Their grids are small, and tests run beside each other: one thread each.
arenite_test(test_fluid unit unit/test_flow_boundary.cpp unit/test_flow_balance.cpp unit/test_anderson_mixing.cpp
  LINK arenite_fluid arenite_verify)
arenite_test(verify_porous_fluid verification verification/verify_porous_fluid.cpp LINK arenite_fluid)
arenite_test(converge_pressure_solver convergence convergence/converge_pressure_solver.cpp LINK arenite_verify)
arenite_test(hash_flow determinism determinism/hash_flow.cpp LINK arenite_fluid)
set_tests_properties(
  test_fluid verify_porous_fluid converge_pressure_solver
  PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1")

# On 128^2 it takes minutes: a test of its own that is run by name, `ctest -C long -L long`.
add_executable(converge_cavity convergence/converge_cavity.cpp)
target_link_libraries(converge_cavity PRIVATE arenite_test_main arenite_verify)
add_test(NAME converge_cavity COMMAND converge_cavity --gtest_filter=Cavity.*)
add_test(NAME converge_cavity_gates CONFIGURATIONS long COMMAND converge_cavity --gtest_filter=CavityGates.*)
set_tests_properties(converge_cavity PROPERTIES LABELS convergence TIMEOUT 600)
set_tests_properties(converge_cavity_gates PROPERTIES LABELS "convergence;long" TIMEOUT 3600)
set_tests_properties(converge_cavity converge_cavity_gates PROPERTIES
  ENVIRONMENT "OMP_NUM_THREADS=1;OMP_PROC_BIND=false")
