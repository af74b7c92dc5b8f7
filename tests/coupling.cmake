# The exchange of grains and fluid. Small cases, and tests run beside each other: one thread each.
arenite_test(test_drag unit unit/test_drag.cpp LINK arenite_fluid)
arenite_test(test_deposit unit unit/test_deposit.cpp LINK arenite_fluid)
arenite_test(test_exchange unit unit/test_exchange.cpp LINK arenite_fluid)
arenite_test(hash_coupling determinism determinism/hash_coupling.cpp LINK arenite_fluid)
set_tests_properties(test_drag test_deposit test_exchange PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1")
