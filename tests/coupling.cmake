arenite_test(test_drag unit unit/test_drag.cpp LINK arenite_fluid)
arenite_test(test_deposit unit unit/test_deposit.cpp LINK arenite_fluid)
arenite_test(test_exchange unit unit/test_exchange.cpp LINK arenite_fluid)
arenite_test(verify_coupling verification verification/verify_coupling.cpp LINK arenite_fluid)
