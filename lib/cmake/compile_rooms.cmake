# Whether a file differs without the libraries of the volumes' formats.
function(wscvt_reads_volume_formats source result)
  file(STRINGS ${source} found REGEX "^#ifdef WSCVT_HAS_(EXPAT|HDF5|NIFTI|PACKERS|TIFF)" LIMIT_COUNT 1)
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

# Compiles the files of a folder together. Files that use CGAL are compiled together whatever their folder is, because
# each of them alone takes five seconds for the same kernel.
function(wscvt_compile_rooms target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source ${ARGN})
    file(STRINGS ${source} heavy REGEX "^#include <(CGAL/Exact_predicates|CGAL/Search|boost/geometry)" LIMIT_COUNT 1)
    wscvt_reads_volume_formats(${source} reads_formats)
    if(heavy MATCHES "CGAL")
      set(group cgal)
    elseif(heavy MATCHES "boost")
      set(group boost_geometry)
    elseif(reads_formats)
      set(group volume_formats)  # Python's module brings its own instead (lib/python/CMakeLists.txt)
    elseif(source MATCHES "/volume/(label_volume|(voxel|smoothed)_surface)")
      set(group label_surface)  # the library for C needs no other file of volumes
    elseif(source MATCHES "/base/mesh[.]cpp$|/remesh_openmesh[.]cpp$")
      set(group openmesh)  # what uses none of its meshes needs no library of it
    elseif(source MATCHES "_windows[.]cpp$")
      set(group windows)  # its header of the system defines words as macros
    else()
      get_filename_component(folder ${source} DIRECTORY)
      get_filename_component(group ${folder} NAME)
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()
