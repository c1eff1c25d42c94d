# Installs the library into an empty folder, then configures, builds and runs the consumer project
# against it. Also checks that README.md shows the consumer's program as it is.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${work_dir})
run(${CMAKE_COMMAND} --install ${build_dir} --prefix ${work_dir}/prefix)
run(${CMAKE_COMMAND} -S ${source_dir}/tests/consumer -B ${work_dir}/build -G ${generator}
  -D CMAKE_BUILD_TYPE=${build_type} "-DCMAKE_CXX_FLAGS=${cxx_flags}"
  -D CMAKE_PREFIX_PATH=${work_dir}/prefix)
run(${CMAKE_COMMAND} --build ${work_dir}/build)
run(${work_dir}/build/consumer ${source_dir}/meshes/sand_7228.ply ${work_dir}/remeshed.off)
foreach(words "500 nodes" "996 faces" "volume" "sphericity")
  if(NOT output MATCHES "${words}")
    message(FATAL_ERROR "\"${words}\" is not in the consumer's report:\n${output}")
  endif()
endforeach()
file(STRINGS ${work_dir}/remeshed.off lines LIMIT_COUNT 2)
list(GET lines 1 counts)
if(NOT counts MATCHES "^500 996")
  message(FATAL_ERROR "The mesh written has the counts \"${counts}\", not 500 996.")
endif()

file(READ ${source_dir}/tests/consumer/main.cpp program)
string(REGEX REPLACE "^//[^\n]*\n" "" program "${program}")
file(READ ${source_dir}/README.md readme)
string(FIND "${readme}" "${program}" place)
if(place EQUAL -1)
  message(FATAL_ERROR "README.md does not show tests/consumer/main.cpp as it is:\n${program}")
endif()
