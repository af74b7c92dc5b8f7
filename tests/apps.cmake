# The driver. One thread: some hundred grains gain nothing from more.
get_target_property(output_sources arenite_output SOURCES)
if("checkpoint_hdf5.cpp" IN_LIST output_sources) # what it compares are checkpoints
  arenite_test(run_small_scene smoke smoke/run_small_scene.cpp LINK arenite_driver nlohmann_json::nlohmann_json)
  target_compile_definitions(run_small_scene PRIVATE ARENITE_TEST_SCENES="${CMAKE_CURRENT_SOURCE_DIR}/scenes")
  set_tests_properties(run_small_scene PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1;OMP_PROC_BIND=false")
endif()

arenite_test(test_driver unit unit/test_stop_signal.cpp unit/test_stage_plan.cpp unit/test_sample.cpp LINK arenite_driver)
target_include_directories(test_driver PRIVATE ${PROJECT_SOURCE_DIR})

arenite_test(refuse_bad_scenes smoke smoke/refuse_bad_scenes.cpp unit/scene_keys.cpp LINK arenite_driver)
set_tests_properties(refuse_bad_scenes PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1;OMP_PROC_BIND=false")

add_test(NAME command_line
  COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/smoke/command_line.sh $<TARGET_FILE:arenite> ${PROJECT_SOURCE_DIR}/scenes)
set_tests_properties(command_line PROPERTIES LABELS smoke TIMEOUT 300)

arenite_test(count_launches performance performance/count_launches.cpp LINK arenite_driver)
arenite_test(launch_ahead determinism determinism/launch_ahead.cpp LINK arenite_driver arenite_verify)
foreach(name count_launches launch_ahead)
  target_compile_definitions(${name} PRIVATE ARENITE_TEST_SCENES="${CMAKE_CURRENT_SOURCE_DIR}/scenes")
  set_tests_properties(${name} PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1;OMP_PROC_BIND=false")
endforeach()

arenite_test(verify_balance verification verification/verify_balance.cpp LINK arenite_driver)
target_include_directories(verify_balance PRIVATE ${PROJECT_SOURCE_DIR})
target_compile_definitions(verify_balance PRIVATE ARENITE_TEST_SCENES="${CMAKE_CURRENT_SOURCE_DIR}/scenes"
  ARENITE_SCENES="${PROJECT_SOURCE_DIR}/scenes")
set_tests_properties(verify_balance PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1;OMP_PROC_BIND=false")

# Hard cases (validation catalogue H1-H20).
foreach(cases hard_grains hard_coupling)
  arenite_test(${cases} stability stability/${cases}.cpp LINK arenite_driver arenite_verify)
  target_include_directories(${cases} PRIVATE ${PROJECT_SOURCE_DIR})
  set_tests_properties(${cases} PROPERTIES ENVIRONMENT "OMP_NUM_THREADS=1;OMP_PROC_BIND=false")
endforeach()

add_test(NAME report
  COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/smoke/report.sh $<TARGET_FILE:arenite> ${CMAKE_CURRENT_SOURCE_DIR}/scenes ${ARENITE_PYTHON})
set_tests_properties(report PROPERTIES LABELS smoke TIMEOUT 600 SKIP_RETURN_CODE 77)
