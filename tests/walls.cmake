arenite_test(test_walls unit unit/test_wall_geometry.cpp unit/test_triangle_mesh.cpp unit/test_stl.cpp unit/test_wall_motion.cpp
  unit/test_wall_contacts.cpp unit/test_wall_surfaces.cpp LINK arenite_kernels arenite_stl arenite_output)
# Steps of a few grains: a second thread would only be waited for.
arenite_test(verify_walls verification verification/verify_walls.cpp verification/verify_servo.cpp LINK arenite_kernels)
set_tests_properties(verify_walls PROPERTIES ENVIRONMENT OMP_NUM_THREADS=1)
