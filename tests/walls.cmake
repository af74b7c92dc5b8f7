arenite_test(test_wall_geometry unit unit/test_wall_geometry.cpp)
arenite_test(test_triangle_mesh unit unit/test_triangle_mesh.cpp)
arenite_test(test_stl unit unit/test_stl.cpp LINK arenite_stl)
arenite_test(test_wall_motion unit unit/test_wall_motion.cpp LINK arenite_core)
add_library(arenite_wall_scene STATIC wall_scene.cpp) # the laws' kernels, compiled once
target_link_libraries(arenite_wall_scene PUBLIC arenite_kernels)
arenite_precompile_headers(arenite_wall_scene)
arenite_test(test_wall_contacts unit unit/test_wall_contacts.cpp LINK arenite_wall_scene)
arenite_test(verify_walls verification verification/verify_walls.cpp LINK arenite_wall_scene)
arenite_test(verify_servo verification verification/verify_servo.cpp LINK arenite_wall_scene)
# Steps of a few grains: a second thread would only be waited for.
set_tests_properties(verify_walls verify_servo PROPERTIES ENVIRONMENT OMP_NUM_THREADS=1)
