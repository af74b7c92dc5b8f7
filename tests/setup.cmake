# What every folder promises: each header compiles alone, and includes point one way only.
find_program(ARENITE_BASH bash)
foreach(check headers_alone include_direction)
  add_test(NAME ${check}
    COMMAND ${ARENITE_BASH} ${CMAKE_CURRENT_SOURCE_DIR}/setup/${check}.sh ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
  set_tests_properties(${check} PROPERTIES LABELS unit TIMEOUT 600 SKIP_RETURN_CODE 77)
endforeach()
