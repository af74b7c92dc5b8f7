# The fluid solver's tests. Their grids are small, and tests run beside each other: one thread each.
arenite_test(test_reproducible_sum unit unit/test_reproducible_sum.cpp)
arenite_test(test_flow_boundary unit unit/test_flow_boundary.cpp LINK arenite_fluid)
arenite_test(test_flow_balance unit unit/test_flow_balance.cpp LINK arenite_fluid)
arenite_test(verify_channel_flow verification verification/verify_channel_flow.cpp LINK arenite_fluid)
arenite_test(verify_porous_fluid verification verification/verify_porous_fluid.cpp LINK arenite_fluid)
arenite_test(verify_cavity verification verification/verify_cavity.cpp LINK arenite_fluid)
arenite_test(converge_taylor_green convergence convergence/converge_taylor_green.cpp LINK arenite_fluid)
arenite_test(converge_manufactured_flow convergence convergence/converge_manufactured_flow.cpp LINK arenite_fluid)
arenite_test(converge_pressure_solver convergence convergence/converge_pressure_solver.cpp LINK arenite_fluid)
arenite_test(hash_flow determinism determinism/hash_flow.cpp LINK arenite_fluid)
set_tests_properties(
  test_flow_boundary test_flow_balance verify_channel_flow verify_porous_fluid verify_cavity
  converge_taylor_green converge_manufactured_flow converge_pressure_solver
  PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1")
