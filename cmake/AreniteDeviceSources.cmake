# Where Kokkos is compiled in CMake's CUDA language, so are all of our sources: a lambda that becomes a
# kernel may be in any of them. Included last, when every target is known. A source that includes no Kokkos
# and whose headers nvcc does not digest (VTK's) opts out with the source property ARENITE_HOST_ONLY.
# A host function that a kernel calls is only a warning to nvcc and a crash on the GPU: an error here. Tests
# may, since they call such templates on the host with lambdas that no device ever sees.
if(NOT Kokkos_COMPILE_LANGUAGE STREQUAL CUDA)
  return()
endif()

# nvcc reads Kokkos' headers anew for every source, three times (for the device, for the host, by the host's compiler), and
# that is most of what a source takes: so it gets the sources of a target by the dozen, in half the time. Two sources of a
# target must therefore not define the same name, not even in unnamed namespaces. (CMake's own unity builds know CUDA only
# since 3.31.)
set(ARENITE_CUDA_SOURCES_TOGETHER 12 CACHE STRING "Sources that nvcc compiles at a time; 1: each alone")

# Replaces the sources (absolute paths) of a target by files in its build folder that include them.
function(arenite_compile_together target directory)
  get_directory_property(build DIRECTORY ${directory} BINARY_DIR)
  set(rest ${ARGN})
  set(number 0)
  while(rest)
    list(SUBLIST rest 0 ${ARENITE_CUDA_SOURCES_TOGETHER} some)
    list(REMOVE_ITEM rest ${some})
    set_source_files_properties(${some} TARGET_DIRECTORY ${target} PROPERTIES HEADER_FILE_ONLY TRUE)
    list(TRANSFORM some REPLACE "(.+)" "#include \"\\1\"\n" OUTPUT_VARIABLE lines)
    string(CONCAT lines ${lines})
    math(EXPR number "${number} + 1")
    set(together ${build}/${target}_${number}.cpp)
    file(CONFIGURE OUTPUT ${together} CONTENT "${lines}" @ONLY)
    set_source_files_properties(${together} TARGET_DIRECTORY ${target} PROPERTIES LANGUAGE CUDA)
    target_sources(${target} PRIVATE ${together})
  endwhile()
endfunction()

function(arenite_compile_as_cuda directory is_test)
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    if(NOT is_test AND type MATCHES "^(STATIC_LIBRARY|OBJECT_LIBRARY|SHARED_LIBRARY|EXECUTABLE)$")
      target_compile_options(${target} PRIVATE
        $<$<COMPILE_LANGUAGE:CUDA>:--Werror=cross-execution-space-call>)
    endif()
    get_target_property(sources ${target} SOURCES)
    set(device_sources "")
    foreach(source ${sources})
      if(NOT source MATCHES "\\.cpp$")
        continue()
      endif()
      cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${directory})
      get_source_file_property(host_only ${source} TARGET_DIRECTORY ${target} ARENITE_HOST_ONLY)
      if(NOT host_only)
        set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES LANGUAGE CUDA)
        list(APPEND device_sources ${source})
      endif()
    endforeach()
    list(LENGTH device_sources count)
    if(count GREATER 1 AND ARENITE_CUDA_SOURCES_TOGETHER GREATER 1)
      arenite_compile_together(${target} ${directory} ${device_sources})
    endif()
  endforeach()
  get_property(subdirectories DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(subdirectory ${subdirectories})
    arenite_compile_as_cuda(${subdirectory} ${is_test})
  endforeach()
endfunction()

foreach(folder core kernels fluid io apps tests perf)
  get_property(known DIRECTORY ${PROJECT_SOURCE_DIR} PROPERTY SUBDIRECTORIES)
  if("${PROJECT_SOURCE_DIR}/${folder}" IN_LIST known)
    string(COMPARE EQUAL ${folder} tests is_test)
    arenite_compile_as_cuda(${PROJECT_SOURCE_DIR}/${folder} ${is_test})
  endif()
endforeach()
