# cmake -D source_dir=DIR -P check.cmake: what the project's texts say of its own files is so. README.md
# keeps to one sitting, all descriptions have one version, the files that texts name are there, no comment leans on a document that is not
# in the repository, and no sentence of the library speaks for its host.
cmake_minimum_required(VERSION 3.22)
set(faults)

file(STRINGS ${source_dir}/README.md lines)
list(LENGTH lines count)
if(count GREATER 110)
  string(APPEND faults "  README.md has ${count} lines, more than 110\n")
endif()
file(READ ${source_dir}/README.md text)
foreach(command filter_wscvt/demo.sh tests/run_all.sh)
  if(NOT text MATCHES "${command}")
    string(APPEND faults "  README.md does not name ${command}\n")
  endif()
endforeach()

file(STRINGS ${source_dir}/lib/wscvt/remesh.cpp lines)
list(LENGTH lines count)
if(count GREATER 250)
  string(APPEND faults "  lib/wscvt/remesh.cpp has ${count} lines, more than 250: it conducts, no more\n")
endif()

file(GLOB pages RELATIVE ${source_dir} ${source_dir}/lib/doc/*.md)
set(texts README.md CONTRIBUTING.md ${pages} filter_wscvt/README.md filter_wscvt/host_blender/README.md lib/README.md lib/c/README.md lib/python/README.md meshes/README.md tests/README.md
  tests/figures/benchmarks/README.md tests/figures/study/README.md tests/figures/study/contacts.md tests/figures/study/virtual_grains.md)
foreach(text ${texts})
  get_filename_component(folder ${source_dir}/${text} DIRECTORY)
  file(READ ${source_dir}/${text} content)
  # Links within the project, and names in code that begin with one of its folders.
  # Brackets that do not match would join the entries of a list.
  string(REPLACE "](" "link:(" linked "${content}")
  string(REGEX MATCHALL "link:\\([^)#]+\\)" links "${linked}")
  string(REGEX MATCHALL
    "(^|[` \n])(\\.\\./)*(lib|tests|filter_wscvt|meshes|packages)/[A-Za-z0-9_./-]*[A-Za-z0-9_/]" names "${content}")
  foreach(name ${links} ${names})
    string(REGEX REPLACE "^link:\\(|\\)$|^[` \n]" "" path "${name}")
    if(path MATCHES "^https?:")
      continue()
    endif()
    if(NOT EXISTS ${folder}/${path} AND NOT EXISTS ${source_dir}/${path})
      string(APPEND faults "  ${text} names ${path}, which is not there\n")
    endif()
  endforeach()
endforeach()

file(GLOB_RECURSE sources RELATIVE ${source_dir} ${source_dir}/lib/*.h ${source_dir}/lib/*.cpp
  ${source_dir}/filter_wscvt/*.h ${source_dir}/filter_wscvt/*.cpp ${source_dir}/meshes/*.cpp
  ${source_dir}/tests/*.h ${source_dir}/tests/*.cpp)
foreach(source ${sources})
  file(STRINGS ${source_dir}/${source} cited REGEX "(of|by|in|\\() ?the design|The design|design\\.md")
  foreach(line ${cited})
    string(APPEND faults "  ${source} cites a document that is not here:${line}\n")
  endforeach()
endforeach()

# What a failure leaves unchanged is the host's to say: the library does not know what its user had.
foreach(source ${sources})
  if(source MATCHES "^lib/")
    file(STRINGS ${source_dir}/${source} said REGEX "Nothing was changed")
    foreach(line ${said})
      string(APPEND faults "  ${source} speaks for its host:${line}\n")
    endforeach()
  endif()
endforeach()

# The descriptions for catalogues name the version that is built.
file(STRINGS ${source_dir}/CMakeLists.txt version REGEX "^project\\(wscvt VERSION ")
string(REGEX REPLACE ".*VERSION ([0-9.]+).*" "\\1" version "${version}")
foreach(description CITATION.cff packages/codemeta.json packages/conda/meta.yaml)
  file(READ ${source_dir}/${description} content)
  if(NOT content MATCHES "version\"?: \"?${version}\"?[,\n]")
    string(APPEND faults "  ${description} does not have the version ${version}\n")
  endif()
endforeach()

if(faults)
  message(FATAL_ERROR "\n${faults}")
endif()
