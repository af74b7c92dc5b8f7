# The executable, the libraries and their headers, and a CMake package: find_package(arenite) gives
# arenite::core, arenite::kernels, arenite::fluid and arenite::io. A Kokkos built here is installed beside.
# Optional parts whose targets the libraries carry add their find_dependency() line to
# arenite_package_dependencies.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# arenite_libraries_in(DIRECTORY RESULT): the library targets of a folder and the folders in it.
function(arenite_libraries_in directory result)
  set(libraries "")
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    if(type MATCHES "LIBRARY$")
      list(APPEND libraries ${target})
    endif()
  endforeach()
  get_property(subdirectories DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(subdirectory ${subdirectories})
    arenite_libraries_in(${subdirectory} deeper)
    list(APPEND libraries ${deeper})
  endforeach()
  set(${result} ${libraries} PARENT_SCOPE)
endfunction()

set(arenite_installed_libraries arenite_flags)
foreach(folder core kernels fluid io apps)
  arenite_libraries_in(${PROJECT_SOURCE_DIR}/${folder} libraries)
  list(APPEND arenite_installed_libraries ${libraries})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/arenite
    FILES_MATCHING PATTERN "*.hpp")
endforeach()
foreach(target ${arenite_installed_libraries})
  string(REGEX REPLACE "^arenite_" "" export_name ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${export_name})
endforeach()
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/arenite)
install(TARGETS ${arenite_installed_libraries} EXPORT areniteTargets)
install(EXPORT areniteTargets NAMESPACE arenite:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/arenite-config.cmake.in
  ${PROJECT_BINARY_DIR}/arenite-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/arenite-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/arenite-config.cmake ${PROJECT_BINARY_DIR}/arenite-config-version.cmake
  DESTINATION ${package_dir})
if(TARGET arenite)
  install(TARGETS arenite)
endif()
