# cmake -D source_dir=DIR -D work_dir=DIR -P run.cmake: the library's rooms are in order, and
# check.cmake does find rooms that are not.
cmake_minimum_required(VERSION 3.22)
function(expect_fault words)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -D library_dir=${work_dir} -P ${source_dir}/tests/rooms/check.cmake
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(result EQUAL 0 OR NOT output MATCHES "${words}")
    message(FATAL_ERROR "\"${words}\" was not found; check.cmake ended with ${result}: ${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${work_dir})
file(WRITE ${work_dir}/wscvt/sphere/low.h "#include \"wscvt/report/high.h\"\n")
file(WRITE ${work_dir}/wscvt/report/high.h "#include <vector>\n")
expect_fault("wscvt/sphere/low.h includes wscvt/report/high.h, of a later room")

file(REMOVE_RECURSE ${work_dir})
file(WRITE ${work_dir}/wscvt/repair/one.h "#include \"wscvt/repair/two.h\"\n")
file(WRITE ${work_dir}/wscvt/repair/two.h "")
file(WRITE ${work_dir}/wscvt/repair/two.cpp "#include \"wscvt/repair/three.h\"\n")
file(WRITE ${work_dir}/wscvt/repair/three.h "#include \"wscvt/repair/one.h\"\n")
expect_fault("wscvt/repair/two includes wscvt/repair/three, in a circle")

file(REMOVE_RECURSE ${work_dir})
file(WRITE ${work_dir}/wscvt/attic/box.h "")
expect_fault("wscvt/attic/box.h stands in a room that the order does not know")

file(REMOVE_RECURSE ${work_dir})
file(WRITE ${work_dir}/wscvt/base/one.cpp "#include \"../../toolbox/clump/clump.h\"\n")
expect_fault("wscvt/base/one.cpp has a way around the rooms")

file(REMOVE_RECURSE ${work_dir})
file(WRITE ${work_dir}/toolbox/clump/one.cpp "double a = std::cos(1.0)\;\n")
expect_fault("toolbox/clump/one.cpp calls what has other values elsewhere")

execute_process(
  COMMAND ${CMAKE_COMMAND} -D library_dir=${source_dir}/lib
    -P ${source_dir}/tests/rooms/check.cmake
  RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${output}")
endif()
