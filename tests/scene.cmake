# Scene files: vocabulary, validation, examples.
arenite_test(test_scene unit unit/test_scene_file.cpp unit/test_scene_values.cpp unit/test_scene_keys.cpp unit/scene_keys.cpp
  unit/test_scene_checks.cpp unit/test_scene_round_trip.cpp unit/test_grain_csv.cpp LINK arenite_scene)
arenite_test(test_scene_examples smoke unit/test_scene_examples.cpp LINK arenite_scene)
foreach(name test_scene test_scene_examples)
  target_compile_definitions(${name} PRIVATE ARENITE_SOURCE_DIR="${CMAKE_CURRENT_LIST_DIR}/..")
endforeach()
