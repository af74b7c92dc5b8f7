# The fluid solver's tests. Their grids are small, and tests run beside each other: one thread each.
arenite_test(test_reproducible_sum unit unit/test_reproducible_sum.cpp)
arenite_test(test_flow_boundary unit unit/test_flow_boundary.cpp LINK arenite_fluid)
arenite_test(test_flow_balance unit unit/test_flow_balance.cpp LINK arenite_fluid)
arenite_test(verify_porous_fluid verification verification/verify_porous_fluid.cpp LINK arenite_fluid)
arenite_test(converge_pressure_solver convergence convergence/converge_pressure_solver.cpp LINK arenite_verify)
arenite_test(converge_cavity convergence convergence/converge_cavity.cpp LINK arenite_verify)
arenite_test(hash_flow determinism determinism/hash_flow.cpp LINK arenite_fluid)
set_tests_properties(
  test_flow_boundary test_flow_balance verify_porous_fluid converge_pressure_solver converge_cavity
  PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1")
