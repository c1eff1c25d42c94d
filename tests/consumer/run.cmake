# Installs the library into an empty folder, then configures, builds and runs the consumer project
# against it. Also checks that README.md shows the consumer's program as it is.
cmake_minimum_required(VERSION 3.22)
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
# Every header that is installed finds what it includes, and machinery is not among them.
file(GLOB_RECURSE headers RELATIVE ${work_dir}/prefix/include ${work_dir}/prefix/include/wscvt/*.h)
list(LENGTH headers count)
if(count LESS 20 OR count GREATER 27)
  message(FATAL_ERROR "${count} headers are installed: ${headers}")
endif()
set(every_header)
foreach(header ${headers})
  if(header MATCHES "/sphere/|_triangulation|/relaxation.h|refinement_|weights|_surface_|half_edges")
    message(FATAL_ERROR "${header} is machinery, and is installed.")
  endif()
  string(APPEND every_header "#include <${header}>\n")
endforeach()
# The shells of the library build on these as well, but for how they write texts and files, and for a
# sample's table and a volume's, which are the program's own.
set(of_the_project wscvt/base/file_name.h wscvt/base/machine_refused.h wscvt/base/output_file.h wscvt/base/readable_text.h
  wscvt/base/text_format.h
  wscvt/remesh/option_advice.h wscvt/report/json.h wscvt/report/sample_summary.h wscvt/report/sample_table.h)
file(GLOB_RECURSE shells ${source_dir}/lib/program/*.h ${source_dir}/lib/program/*.cpp
  ${source_dir}/lib/python/*.cpp ${source_dir}/filter_wscvt/*.h ${source_dir}/filter_wscvt/*.cpp)
foreach(shell ${shells})
  file(STRINGS ${shell} lines REGEX "^ *# *include *[<\"]wscvt/")
  foreach(line ${lines})
    string(REGEX REPLACE ".*[<\"](wscvt/[^>\"]+)[>\"].*" "\\1" included ${line})
    if(NOT included IN_LIST headers AND NOT included IN_LIST of_the_project)
      message(FATAL_ERROR "${shell} includes ${included}, which is not installed.")
    endif()
  endforeach()
endforeach()
file(WRITE ${work_dir}/every_header.cpp "${every_header}")
run(${CMAKE_COMMAND} -S ${source_dir}/tests/consumer -D every_header=${work_dir}/every_header.cpp -B ${work_dir}/build -G ${generator}
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
