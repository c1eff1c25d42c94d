# What filter_wscvt/meshlab.cmake finds out about sources and libraries:
#   cmake -D meshlab_cmake=... -D library=... -D version=... -D work_dir=... -P meshlab_cmake_test.cmake
# Calls itself with -D call=... for what must fail.
cmake_minimum_required(VERSION 3.22)
include(${meshlab_cmake})
if(call)
  cmake_language(EVAL CODE "${call}")
  return()
endif()
file(REMOVE_RECURSE ${work_dir})

function(expect_equal actual expected)
  if(NOT actual STREQUAL expected)
    message(FATAL_ERROR "'${actual}' should be '${expected}'")
  endif()
endfunction()

function(expect_refusal call)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -D meshlab_cmake=${meshlab_cmake} -D call=${call}
            -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    RESULT_VARIABLE code ERROR_VARIABLE sentence OUTPUT_QUIET)
  if(code EQUAL 0)
    message(FATAL_ERROR "${call} is not refused")
  endif()
  string(REGEX REPLACE "[ \n]+" " " sentence "${sentence}")
  foreach(words IN LISTS ARGN)
    string(FIND "${sentence}" "${words}" at)
    if(at EQUAL -1)
      message(FATAL_ERROR "'${words}' is not in: ${sentence}")
    endif()
  endforeach()
endfunction()

# Every version has its adapter; any other is refused with the list.
foreach(case 2020.09=host_2020_09 2021.10=host_2021_10 2022.02=host_2021_10 2023.12=host_2021_10
        2025.07=host_2021_10)
  string(REPLACE = ";" case ${case})
  list(GET case 0 source_version)
  list(GET case 1 expected)
  file(WRITE ${work_dir}/${source_version}/ML_VERSION ${source_version})
  wscvt_read_meshlab_source(${work_dir}/${source_version} found_version found_host)
  expect_equal(${found_version} ${source_version})
  expect_equal(${found_host} ${expected})
endforeach()
file(WRITE ${work_dir}/other/ML_VERSION 2021.05)
expect_refusal("wscvt_read_meshlab_source(${work_dir}/other version host)"
  "2021.05" "2020.09, 2021.10, 2022.02, 2023.12, 2025.07")
expect_refusal("wscvt_read_meshlab_source(${work_dir}/nowhere version host)" "get_meshlab_source.sh")

# The library that is installed, one of the other scalar type and one that tells nothing.
wscvt_read_meshlab_library(${library} found_version found_scalar)
expect_equal(${found_version} ${version})
expect_equal(${found_scalar} float)
file(WRITE ${work_dir}/double.so
  "\n_ZN26MLSceneGLSharedDataContext28setSceneTransformationMatrixERKN3vcg8Matrix44IdEE\n2025.07d\n")
wscvt_read_meshlab_library(${work_dir}/double.so found_version found_scalar)
expect_equal(${found_version} 2025.07)
expect_equal(${found_scalar} double)
file(WRITE ${work_dir}/silent.so "\n2025.07\n")
expect_refusal("wscvt_read_meshlab_library(${work_dir}/silent.so version scalar)"
  "float or for double" "MESHLAB_COMMON_LIBRARY")
