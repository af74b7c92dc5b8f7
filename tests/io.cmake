# Output. What needs an optional part is tested where the part is there.
arenite_test(test_output unit unit/test_atomic_file.cpp unit/test_time_series.cpp unit/test_summary.cpp
  LINK arenite_output nlohmann_json::nlohmann_json)
if(TARGET arenite_hdf5)
  target_sources(test_output PRIVATE unit/test_checkpoint.cpp)
  target_link_libraries(test_output PRIVATE arenite_hdf5)
endif()
if(TARGET VTK::IOXML)
  set_source_files_properties(unit/vtk_read.cpp PROPERTIES ARENITE_HOST_ONLY TRUE)
  target_sources(test_output PRIVATE unit/test_field_output.cpp unit/test_streamlines.cpp unit/vtk_read.cpp)
  target_link_libraries(test_output PRIVATE VTK::IOXML)
endif()
