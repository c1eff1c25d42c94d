# Installs the library into an empty folder, then configures and builds the examples against it, and runs
# them. Also checks that lib/README.md shows the first of them as it is.
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
file(GLOB_RECURSE headers RELATIVE ${work_dir}/prefix/include/wscvt-3 ${work_dir}/prefix/include/wscvt-3/*.h)
set(every_header)
foreach(header ${headers})
  if(header MATCHES "/sphere/|_triangulation|/relaxation.h|refinement_|weights|_surface_|half_edges")
    message(FATAL_ERROR "${header} is machinery, and is installed.")
  endif()
  string(APPEND every_header "#include <${header}>\n")
endforeach()
# lib/README.md's table of rooms names them, each in its room, and no others.
file(STRINGS ${source_dir}/lib/README.md rows REGEX "^\\| `(wscvt|toolbox)/[a-z_.]+/?` \\|")
set(named)
foreach(row ${rows})
  string(REGEX MATCH "^\\| `((wscvt|toolbox)/([a-z_]+/)?)" found "${row}")
  set(room ${CMAKE_MATCH_1})
  string(REGEX REPLACE ".*\\|([^|]*)\\|$" "\\1" cell "${row}")
  string(REGEX MATCHALL "[a-z_]+\\.h" names "${cell}")
  foreach(name ${names})
    list(APPEND named ${room}${name})
  endforeach()
endforeach()
list(SORT named)
set(installed ${headers})
list(SORT installed)
if(NOT named STREQUAL installed)
  message(FATAL_ERROR "lib/README.md's table of rooms names\n${named}\nInstalled are\n${installed}")
endif()
# The shells of the library build on these as well: how they write texts and files, tables of samples and
# volumes, contacts of a batch, and virtual grains, which the program and Python offer, but no C++ interface yet.
set(of_the_project wscvt/base/convex_hull.h wscvt/base/lower_case.h toolbox/clump/scan_contacts.h
  toolbox/sample/quick_shape.h wscvt/repair/folded_solid_angle.h wscvt/base/file_name.h wscvt/base/machine_refused.h
  wscvt/base/option_words.h wscvt/base/output_file.h wscvt/base/pi.h wscvt/base/readable_text.h
  wscvt/base/text_format.h toolbox/exchange/distance_grid.h toolbox/exchange/node_table.h
  toolbox/exchange/template_files.h wscvt/measures/form_axes.h wscvt/remesh/option_advice.h wscvt/remesh/remesh_warnings.h
  wscvt/report/descriptor_report.h wscvt/report/json.h wscvt/report/mass_table.h
  toolbox/report/sample_summary.h toolbox/report/sample_table.h
  toolbox/report/shape_table.h toolbox/sample/given_sizes.h toolbox/sample/grain_grower.h
  toolbox/sample/grow_options.h
  toolbox/sample/grown_mesh.h toolbox/sample/nearest_grain.h toolbox/sample/sample_grain.h
  wscvt/repair/bodies.h wscvt/repair/mesh_check.h
  wscvt/sphere/sphere_triangulation.h wscvt/surface/shtools_io.h)
file(GLOB_RECURSE shells ${source_dir}/lib/program/*.h ${source_dir}/lib/program/*.cpp
  ${source_dir}/lib/python/*.cpp ${source_dir}/filter_wscvt/*.h ${source_dir}/filter_wscvt/*.cpp)
foreach(shell ${shells})
  file(STRINGS ${shell} lines REGEX "^ *# *include *[<\"](wscvt|toolbox)/")
  foreach(line ${lines})
    string(REGEX REPLACE ".*[<\"]((wscvt|toolbox)/[^>\"]+)[>\"].*" "\\1" included ${line})
    if(NOT included IN_LIST headers AND NOT included IN_LIST of_the_project)
      message(FATAL_ERROR "${shell} includes ${included}, which is not installed.")
    endif()
  endforeach()
endforeach()
file(WRITE ${work_dir}/every_header.cpp "${every_header}")
run(${CMAKE_COMMAND} -S ${source_dir}/tests/consumer -D every_header=${work_dir}/every_header.cpp
  -D examples_dir=${source_dir}/lib/examples -B ${work_dir}/build -G ${generator}
  -D CMAKE_BUILD_TYPE=${build_type} "-DCMAKE_CXX_FLAGS=${cxx_flags}"
  -D CMAKE_PREFIX_PATH=${work_dir}/prefix)
run(${CMAKE_COMMAND} --build ${work_dir}/build)
run(${work_dir}/build/one_grain ${source_dir}/meshes/sand_7228.ply ${work_dir}/remeshed.off)
foreach(words "500 nodes" "996 faces" "volume" "sphericity")
  if(NOT output MATCHES "${words}")
    message(FATAL_ERROR "\"${words}\" is not in the report:\n${output}")
  endif()
endforeach()
file(STRINGS ${work_dir}/remeshed.off lines LIMIT_COUNT 2)
list(GET lines 1 counts)
if(NOT counts MATCHES "^500 996")
  message(FATAL_ERROR "The mesh written has the counts \"${counts}\", not 500 996.")
endif()

file(MAKE_DIRECTORY ${work_dir}/batch)
run(${work_dir}/build/batch ${work_dir}/batch ${source_dir}/meshes/sand_5658.ply ${source_dir}/meshes/angular_6000.ply)
file(STRINGS ${work_dir}/batch/grains.csv rows)
list(LENGTH rows count)
if(NOT count EQUAL 3 OR NOT EXISTS ${work_dir}/batch/angular_6000.ply)
  message(FATAL_ERROR "The batch's table has ${count} lines, not 3.")
endif()
file(WRITE ${work_dir}/sand.csv "grain,axis_i_box [mm],volume [mm^3]\na,1,1\nb,2,8\nc,3,27\n")
run(${work_dir}/build/sample ${work_dir}/sand.csv ${work_dir}/sand.html)
# Half of the mass, 18 of 36, lies between the middles of b and c, 5 and 22.5.
if(NOT output MATCHES "3 grains: D50 by mass 2\\.74286 mm .*, Cu .*mean of volume 12 mm\\^3" OR
   NOT EXISTS ${work_dir}/sand.html)
  message(FATAL_ERROR "The sample's statistics are not told:\n${output}")
endif()
run(${work_dir}/build/own_surface ${work_dir}/bump.ply)
# By quadrature of (2 pi / 3) (1 + .3 exp(-8 (1 - z)))^3 over z: 4.4621. The mesh lacks 0.2 to 1 %.
if(NOT output MATCHES "volume of the formula 4\\.4621[0-9]*, of the mesh 4\\.4[0-9]*")
  message(FATAL_ERROR "The bump has another volume:\n${output}")
endif()
run(${work_dir}/build/distances ${work_dir}/batch/sand_5658.ply ${source_dir}/meshes/sand_5658.ply)
if(NOT output MATCHES "two-sided rms 0\\.00[0-9]+, largest .*vertex [0-9]+ at")
  message(FATAL_ERROR "The distances are not told:\n${output}")
endif()

run(${work_dir}/build/half_edges ${source_dir}/meshes/sand_5658.ply)
# A closed mesh of genus 0 has 3 n - 6 edges.
if(NOT output MATCHES "500 nodes with 2988 neighbours; the sharpest edge, [0-3]\\.[0-9]+ rad, is at height")
  message(FATAL_ERROR "The half-edges are not told:\n${output}")
endif()

file(READ ${source_dir}/lib/examples/one_grain.cpp program)
string(REGEX REPLACE "^//[^\n]*\n" "" program "${program}")
file(READ ${source_dir}/lib/README.md readme)
string(FIND "${readme}" "${program}" place)
if(place EQUAL -1)
  message(FATAL_ERROR "lib/README.md does not show lib/examples/one_grain.cpp as it is:\n${program}")
endif()
