# cpack -G DEB in the build folder: Debian packages of the program, of the library for those who build
# on it, and, where it is built, of the plugin for the MeshLab there.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME wscvt)
set(CPACK_PACKAGE_VENDOR wscvt)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
# Debian's policy asks for a person and an address that works. The sources name none, so whoever makes
# the packages does, as for Debian's own tools. No mail reaches example.org (RFC 2606).
set(maintainer "The wscvt authors <wscvt@example.org>")
if(NOT "$ENV{DEBFULLNAME}" STREQUAL "" AND NOT "$ENV{DEBEMAIL}" STREQUAL "")
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(WSCVT_MAINTAINER "${maintainer}" CACHE STRING
  "Who answers for the Debian packages: Name <address>")
set(CPACK_PACKAGE_CONTACT ${WSCVT_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENTS_ALL development)
# Scripts and plugins need no bit that lets others write.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
  GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# What Debian's policy wants of each package, and the texts that its users read.
include(GNUInstallDirs)
set(documents ${CMAKE_CURRENT_BINARY_DIR}/documents)
file(MAKE_DIRECTORY ${documents})
file(READ packages/debian/changelog changelog)
string(CONFIGURE "${changelog}" changelog @ONLY)
file(WRITE ${documents}/changelog "${changelog}")
execute_process(COMMAND gzip -9nf ${documents}/changelog COMMAND_ERROR_IS_FATAL ANY)
function(wscvt_install_documents component package)
  install(FILES packages/debian/copyright ${documents}/changelog.gz ${ARGN}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endfunction()
wscvt_install_documents(development libwscvt-dev)

set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Remeshing of scanned grains: library
A static library that remeshes dense scans of grains to an exact number of
nodes, with its headers and what find_package(wscvt) needs.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libwscvt-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libopenmesh-dev, libeigen3-dev, libcgal-dev, zlib1g-dev, nlohmann-json3-dev, libtiff-dev, libexpat1-dev, libpng-dev, liblz4-dev, libminizip-dev, libnifti2-dev, libhdf5-dev")
if(WSCVT_HAS_ITK)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libinsighttoolkit5-dev")
endif()

list(APPEND CPACK_COMPONENTS_ALL program)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Remeshing of scanned grains: program
wscvt remeshes dense scans of grains to an exact number of nodes, one or a
whole sample, and measures their shape.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME wscvt)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
wscvt_install_documents(program wscvt README.md CHANGELOG.md)
install(FILES lib/doc/program.md lib/doc/method.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/wscvt/lib/doc COMPONENT program)

if(WSCVT_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Remeshing of scanned grains: Python module
wscvt remeshes dense scans of grains, as NumPy arrays, to an exact number of
nodes, and measures their shape.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-wscvt)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  wscvt_install_documents(python python3-wscvt lib/python/README.md)
  # The module is for one version of Python.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3, python3-numpy, python${PYTHON_VERSION_MAJOR}.${PYTHON_VERSION_MINOR}")
endif()

if(TARGET filter_wscvt)
  list(APPEND CPACK_COMPONENTS_ALL meshlab_plugin)
  set(CPACK_COMPONENT_MESHLAB_PLUGIN_DESCRIPTION "Remeshing of scanned grains: plugin for MeshLab
Filters that remesh dense scans of grains to an exact number of nodes and
measure their shape.")
  set(CPACK_DEBIAN_MESHLAB_PLUGIN_PACKAGE_NAME wscvt-meshlab-plugin)
  set(CPACK_DEBIAN_MESHLAB_PLUGIN_PACKAGE_SECTION science)
  wscvt_install_documents(meshlab_plugin wscvt-meshlab-plugin filter_wscvt/README.md)
  file(GLOB scripts filter_wscvt/*.mlx)
  install(FILES ${scripts} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/wscvt-meshlab-plugin/examples
    COMPONENT meshlab_plugin)
  # It loads into the version it was built for, and into no other.
  set(CPACK_DEBIAN_MESHLAB_PLUGIN_PACKAGE_DEPENDS
    "meshlab (>= ${wscvt_meshlab_version}), meshlab (<< ${wscvt_meshlab_version}.)")
  get_filename_component(meshlab_library_dir ${MESHLAB_COMMON_LIBRARY} DIRECTORY)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${meshlab_library_dir})
endif()
include(CPack)
