# cmake -D library_dir=DIR -P check.cmake: reads every `#include "wscvt/..."` and `#include "toolbox/..."`
# below DIR, which holds the folders wscvt/ and toolbox/. Fails, naming file and include, when a room includes one that comes after it, or
# when subjects, a header with its source, include each other in a circle; and when one, or a file of the
# program, calls a function whose value each platform chooses.
#
# What stands in no room, remesh.h, conducts them and comes last. Only a new room needs a line here.
cmake_minimum_required(VERSION 3.22)
set(order wscvt/base wscvt/sphere wscvt/mesh_files wscvt/repair wscvt/surface wscvt/measures
  wscvt/tessellation wscvt/nodes wscvt/remesh wscvt/report toolbox/map toolbox/clump toolbox/convex toolbox/sample
  toolbox/fragment toolbox/tetrahedra toolbox/report toolbox/exchange toolbox/volume toolbox/resolution toolbox/job
  toolbox/fabric toolbox/conforming)

file(GLOB_RECURSE files RELATIVE ${library_dir} ${library_dir}/wscvt/*.h ${library_dir}/wscvt/*.cpp
  ${library_dir}/toolbox/*.h ${library_dir}/toolbox/*.cpp)
if(NOT files)
  message(FATAL_ERROR "There is no source below ${library_dir}/wscvt.")
endif()

function(room_of file result)
  if(file MATCHES "^((wscvt|toolbox)/[^/]+)/")
    set(room ${CMAKE_MATCH_1})
  else()
    set(room wscvt/remesh)
  endif()
  list(FIND order ${room} place)
  if(place EQUAL -1)
    message(FATAL_ERROR "${file} stands in a room that the order does not know: ${order}.")
  endif()
  set(${result} ${place} PARENT_SCOPE)
endfunction()

set(faults)
set(subjects)
foreach(file ${files})
  room_of(${file} room)
  string(REGEX REPLACE "\\.(h|cpp)$" "" subject ${file})
  list(APPEND subjects ${subject})
  file(STRINGS ${library_dir}/${file} around REGEX "^ *# *include *[<\"][^>\"]*\\.\\./")
  if(around)
    string(APPEND faults "  ${file} has a way around the rooms, give it from the library's folder: ${around}\n")
  endif()
  file(STRINGS ${library_dir}/${file} lines REGEX "^ *# *include *[<\"](wscvt|toolbox)/")
  foreach(line ${lines})
    string(REGEX REPLACE ".*[<\"]((wscvt|toolbox)/[^>\"]+)[>\"].*" "\\1" included ${line})
    room_of(${included} included_room)
    if(included_room GREATER room)
      string(APPEND faults "  ${file} includes ${included}, of a later room\n")
    endif()
    string(REGEX REPLACE "\\.h$" "" needed ${included})
    if(NOT needed STREQUAL subject)
      list(APPEND needs_${subject} ${needed})
    endif()
  endforeach()
endforeach()

# Their values are the platform's choice; sqrt, floor, ldexp and the like are exact.
set(chosen_functions sin cos tan asin acos atan atan2 exp exp2 expm1 log log2 log10 log1p pow cbrt hypot sinh cosh tanh
  asinh acosh atanh erf erfc tgamma lgamma polar arg fma)
list(JOIN chosen_functions "|" chosen)
file(GLOB_RECURSE others RELATIVE ${library_dir} ${library_dir}/program/*.h ${library_dir}/program/*.cpp)
foreach(file ${files} ${others})
  file(STRINGS ${library_dir}/${file} calls REGEX
    "std::(${chosen})\\(|array\\(\\)\\.(${chosen})\\(|AngleAxis|angularDistance|slerp\\(|computeDirect\\(|eulerAngles\\(")
  if(calls AND NOT file MATCHES "^wscvt/base/portable_math")
    string(APPEND faults "  ${file} calls what has other values elsewhere, which wscvt/base/portable_math.h has not: ${calls}\n")
  endif()
endforeach()

# Subjects that need nothing but what is struck out already are struck out; a circle remains.
list(REMOVE_DUPLICATES subjects)
set(struck TRUE)
while(struck)
  set(struck FALSE)
  foreach(subject ${subjects})
    set(open FALSE)
    foreach(needed ${needs_${subject}})
      if(needed IN_LIST subjects)
        set(open TRUE)
        break()
      endif()
    endforeach()
    if(NOT open)
      list(REMOVE_ITEM subjects ${subject})
      set(struck TRUE)
    endif()
  endforeach()
endwhile()
foreach(subject ${subjects})
  foreach(needed ${needs_${subject}})
    if(needed IN_LIST subjects)
      string(APPEND faults "  ${subject} includes ${needed}, in a circle or on the way to one\n")
    endif()
  endforeach()
endforeach()

if(faults)
  list(JOIN order ", " text)
  message(FATAL_ERROR "The rooms are, from the ground up: ${text}.\n${faults}")
endif()
