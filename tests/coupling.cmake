# The exchange of grains and fluid. Small cases, and tests run beside each other: one thread each.
arenite_test(test_coupling unit unit/test_drag.cpp unit/test_deposit.cpp unit/test_exchange.cpp LINK arenite_fluid)
arenite_test(hash_coupling determinism determinism/hash_coupling.cpp LINK arenite_fluid)
set_tests_properties(test_coupling PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1")
