# The laws' kernels, compiled once.
add_library(arenite_wall_scene STATIC wall_scene.cpp)
target_link_libraries(arenite_wall_scene PUBLIC arenite_kernels)
arenite_precompile_headers(arenite_wall_scene)
arenite_test(test_walls unit unit/test_wall_geometry.cpp unit/test_triangle_mesh.cpp unit/test_stl.cpp unit/test_wall_motion.cpp
  unit/test_wall_contacts.cpp unit/test_wall_surfaces.cpp LINK arenite_wall_scene arenite_stl arenite_output)
arenite_test(verify_walls verification verification/verify_walls.cpp LINK arenite_wall_scene)
arenite_test(verify_servo verification verification/verify_servo.cpp LINK arenite_wall_scene)
# Steps of a few grains: a second thread would only be waited for.
set_tests_properties(verify_walls verify_servo PROPERTIES ENVIRONMENT OMP_NUM_THREADS=1)
