# Compiles the files of a folder together. Files that use CGAL are compiled together whatever their folder is, because
# each of them alone takes five seconds for the same kernel.
function(wscvt_compile_rooms target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source ${ARGN})
    file(STRINGS ${source} heavy REGEX "^#include <(CGAL/Exact_predicates|CGAL/Search|boost/geometry)" LIMIT_COUNT 1)
    if(heavy MATCHES "CGAL")
      set(group cgal)
    elseif(heavy MATCHES "boost")
      set(group boost_geometry)
    elseif(source MATCHES "/volume/(label_volume|(voxel|smoothed)_surface)")
      # Python needs only these files of the volumes, and not the libraries of the file formats.
      set(group label_surface)
    elseif(source MATCHES "/base/mesh[.]cpp$|/remesh_openmesh[.]cpp$")
      set(group openmesh)  # what uses none of its meshes needs no library of it
    elseif(source MATCHES "_windows[.]cpp$")
      set(group windows)  # its header of the system defines words as macros
    elseif(source MATCHES "/job/label_source")
      set(group volume)  # also not needed by Python
    else()
      get_filename_component(folder ${source} DIRECTORY)
      get_filename_component(group ${folder} NAME)
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()
