# cmake -D source_dir=DIR -D work_dir=DIR -D generator=NAME -P run.cmake: the library alone configures
# where there is no GoogleTest, no CLI11, no Qt and no MeshLab, installs nothing else, and its
# sources include nothing of theirs.
cmake_minimum_required(VERSION 3.22)
file(REMOVE_RECURSE ${work_dir})
set(absent)
foreach(package GTest CLI11 Qt5 benchmark pybind11)
  list(APPEND absent -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
execute_process(
  COMMAND ${CMAKE_COMMAND} -S ${source_dir} -B ${work_dir} -G ${generator} ${absent}
    -D WSCVT_BUILD_TESTS=OFF -D WSCVT_BUILD_PROGRAM=OFF
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "The library alone does not configure:\n${output}")
endif()
# What there is to build: the library.
execute_process(COMMAND ${CMAKE_COMMAND} --build ${work_dir} --target help
  OUTPUT_VARIABLE targets ERROR_VARIABLE targets)
if(NOT targets MATCHES "wscvt:")
  message(FATAL_ERROR "There is no library to build:\n${targets}")
endif()
if(targets MATCHES "(wscvt_program|[a-z]+_tests|filter_wscvt):")
  message(FATAL_ERROR "More than the library is to be built: ${CMAKE_MATCH_1}.")
endif()

file(GLOB_RECURSE sources ${source_dir}/lib/wscvt/*.h ${source_dir}/lib/wscvt/*.cpp
  ${source_dir}/lib/toolbox/*.h ${source_dir}/lib/toolbox/*.cpp)
foreach(source ${sources})
  file(STRINGS ${source} includes
    REGEX "^ *# *include *[<\"](gtest|gmock|benchmark|CLI|Q[A-Z]|vcg|common/|meshlab)")
  if(includes)
    message(FATAL_ERROR "${source} needs more than the library may: ${includes}")
  endif()
endforeach()
