# Finds properties of a MeshLab from its sources and its library.

# Version of the sources in a folder, and our folder for this version.
function(wscvt_read_meshlab_source folder version_variable host_variable)
  if(NOT EXISTS ${folder}/ML_VERSION)
    message(FATAL_ERROR "${folder} has no ML_VERSION. Give the unpacked source of MeshLab "
      "(filter_wscvt/get_meshlab_source.sh fetches it).")
  endif()
  file(STRINGS ${folder}/ML_VERSION version LIMIT_COUNT 1)
  # The versions that share an interface, by the folder with the adapter to it.
  set(versions_of_host_2020_09 2020.09)
  set(versions_of_host_2021_10 2021.10 2022.02 2023.12 2025.07)
  set(known)
  foreach(host host_2020_09 host_2021_10)
    if(version IN_LIST versions_of_${host})
      set(${version_variable} ${version} PARENT_SCOPE)
      set(${host_variable} ${host} PARENT_SCOPE)
      return()
    endif()
    list(APPEND known ${versions_of_${host}})
  endforeach()
  list(JOIN known ", " known)
  message(FATAL_ERROR "${folder} is MeshLab ${version}, but the plugin supports ${known}. "
    "Plugins load only into the version they were built for.")
endfunction()

# Version and scalar type with which a libmeshlab-common was built. A plugin for the other type would
# crash the host: it reads coordinates of another size. The type is part of the symbol of a function
# with a matrix argument that every version has. The version is a text in the library.
function(wscvt_read_meshlab_library library version_variable scalar_variable)
  file(STRINGS ${library} matrices REGEX "setSceneTransformationMatrixERKN3vcg8Matrix44I[fd]EE")
  file(STRINGS ${library} versions REGEX "^20[0-9][0-9]\\.[0-9][0-9]d?$")
  if(matrices MATCHES "Matrix44IfEE")
    set(${scalar_variable} float PARENT_SCOPE)
  elseif(matrices MATCHES "Matrix44IdEE")
    set(${scalar_variable} double PARENT_SCOPE)
  else()
    message(FATAL_ERROR "${library} does not show whether it was built for float or for double. "
      "Give MeshLab's own library as MESHLAB_COMMON_LIBRARY.")
  endif()
  string(REGEX MATCH "20[0-9][0-9]\\.[0-9][0-9]" version "${versions}")
  set(${version_variable} "${version}" PARENT_SCOPE)
endfunction()

# An interface target with the headers of a MeshLab, for its plugin and for tests that play it.
function(wscvt_add_meshlab target folder version scalar library)
  # Imported targets are visible only in the calling folder.
  find_package(Qt5 REQUIRED COMPONENTS Core Widgets OpenGL Xml XmlPatterns)
  find_package(GLEW REQUIRED)
  find_package(Eigen3 REQUIRED NO_MODULE)
  add_library(${target} INTERFACE)
  # vcglib was next to src until 2020.09.
  target_include_directories(${target} SYSTEM INTERFACE
    ${folder}/src ${folder}/vcglib ${folder}/src/vcglib)
  target_compile_definitions(${target} INTERFACE
    MESHLAB_SCALAR=${scalar} MESHLAB_VERSION=${version})
  if(EXISTS ${folder}/src/common/parameters/rich_parameters.h)
    target_compile_definitions(${target} INTERFACE WSCVT_MESHLAB_NAMES_FILES_FIRST)
  endif()
  target_link_libraries(${target} INTERFACE ${library}
    Qt5::Core Qt5::Widgets Qt5::OpenGL Qt5::Xml Qt5::XmlPatterns GLEW::GLEW Eigen3::Eigen)
endfunction()

# The plugin for a MeshLab.
function(wscvt_add_plugin target host meshlab)
  add_library(${target} MODULE
    ${PROJECT_SOURCE_DIR}/filter_wscvt/${host}/filter_wscvt.cpp
    ${PROJECT_SOURCE_DIR}/filter_wscvt/${host}/filter_wscvt.h)
  # The header's metadata wants no library built first, so that a file can be read alone without one.
  set_target_properties(${target} PROPERTIES AUTOMOC ON AUTOGEN_ORIGIN_DEPENDS OFF
    CXX_VISIBILITY_PRESET hidden LINKER_LANGUAGE CXX)
  target_link_libraries(${target} PRIVATE wscvt_filter ${meshlab} wscvt_warnings)
  # Hides the library's symbols from other plugins, which may contain the same libraries.
  target_link_options(${target} PRIVATE -Wl,--exclude-libs,ALL -Wl,--no-undefined)
endfunction()
