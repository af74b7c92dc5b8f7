# Where Kokkos is compiled in CMake's CUDA language, so are all of our sources: a lambda that becomes a
# kernel may be in any of them. Included last, when every target is known. A source that includes no Kokkos
# and whose headers nvcc does not digest (VTK's) opts out with the source property ARENITE_HOST_ONLY.
# A host function that a kernel calls is only a warning to nvcc and a crash on the GPU: an error here. Tests
# may, since they call such templates on the host with lambdas that no device ever sees.
if(NOT Kokkos_COMPILE_LANGUAGE STREQUAL CUDA)
  return()
endif()

function(arenite_compile_as_cuda directory is_test)
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    if(NOT is_test AND type MATCHES "^(STATIC_LIBRARY|OBJECT_LIBRARY|SHARED_LIBRARY|EXECUTABLE)$")
      target_compile_options(${target} PRIVATE
        $<$<COMPILE_LANGUAGE:CUDA>:--Werror=cross-execution-space-call>)
    endif()
    get_target_property(sources ${target} SOURCES)
    foreach(source ${sources})
      if(NOT source MATCHES "\\.cpp$")
        continue()
      endif()
      cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${directory})
      get_source_file_property(host_only ${source} TARGET_DIRECTORY ${target} ARENITE_HOST_ONLY)
      if(NOT host_only)
        set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES LANGUAGE CUDA)
      endif()
    endforeach()
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
