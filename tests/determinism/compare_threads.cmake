# H18. cmake -D PROGRAM=... -D "ARGUMENTS=..." -P compare_threads.cmake: the program prints the same line with 1, 2
# and 3 threads. The line has to be there: an empty one would always be equal.
foreach(threads 1 2 3)
  execute_process(COMMAND ${PROGRAM} ${ARGUMENTS} --kokkos-num-threads=${threads}
    OUTPUT_VARIABLE output RESULT_VARIABLE status)
  string(REGEX MATCH "hash [0-9a-f]+, [0-9]+ searches" line "${output}")
  if(NOT status EQUAL 0 OR line STREQUAL "")
    message(FATAL_ERROR "${threads} threads: exit status ${status}, output: ${output}")
  endif()
  if(threads EQUAL 1)
    set(reference "${line}")
  elseif(NOT line STREQUAL reference)
    message(FATAL_ERROR "${threads} threads: ${line}; 1 thread: ${reference}")
  endif()
endforeach()
message(STATUS "${reference} with 1, 2 and 3 threads")
