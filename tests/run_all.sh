#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds everything and runs every test.
#   tests/run_all.sh [install] [release] [extras] [nightly] [sanitizers] [replay] [format] [tidy] [docs] [page] [web] [static] [wine] [engines] [package] [debian-source] [release-files] [pip] [types] [wheel] [blender] [blender13] [slurm] [workflow] [windows] [debian12] [debian13] [sid]
# Without arguments: install and release. tests/README.md explains each step. The sanitized
# build has no assertions of CGAL (CGAL_NDEBUG), because they make some tests a hundred times slower. It has
# those of Eigen, OpenMesh and the standard library.
set -eu
cd "$(dirname "$0")/.."
jobs=$(nproc)
tests=$((jobs + 1))  # at a time: those of windows wait
meshlab_source=$PWD/build/meshlab-source
newer_source=$PWD/build/meshlab-source-trixie
newest_source=$PWD/build/meshlab-source-sid

sources() { find "$@" \( -name '*.h' -o -name '*.cpp' \) | sort; }

configure() {  # preset, more options
  preset=$1
  shift
  cmake --preset "$preset" -DWSCVT_WARNINGS_AS_ERRORS=ON -DMESHLAB_SOURCE_DIR="$meshlab_source" "$@"
}

configure_and_build() {
  configure "$@"
  cmake --build --preset "$1" -j "$jobs"
}

# Compile commands that name each file alone, in build/files, where nothing is built but the metadata
# that the plugin includes: those of release name files that are compiled together.
commands_file_by_file() {  # more options
  cmake --preset release -B build/files -DWSCVT_WARNINGS_AS_ERRORS=ON -DWSCVT_QUICK_BUILD=OFF \
    -DMESHLAB_SOURCE_DIR="$meshlab_source" "$@"
  cmake --build build/files --target filter_wscvt_autogen
}

[ $# -gt 0 ] || set -- install release
for step in "$@"; do
  echo "== $step"
  case $step in
    install)
      tests/install_packages.sh
      filter_wscvt/get_meshlab_source.sh "$meshlab_source"
      # For the plugin of versions that are not installed: those of Debian 13 and of Debian unstable.
      filter_wscvt/get_meshlab_source.sh "$newer_source" trixie
      filter_wscvt/get_meshlab_source.sh "$newest_source" sid ;;
    release)
      others=$newer_source
      # Unstable may move on to a version that the plugin does not know.
      if [ "$(cat "$newest_source/ML_VERSION")" = 2025.07 ]; then
        others="$others;$newest_source"
      else
        echo "Debian unstable has MeshLab $(cat "$newest_source/ML_VERSION") now, so 2025.07 is not tested." >&2
      fi
      configure_and_build release -DWSCVT_BUILD_BENCHMARKS=OFF -DWSCVT_BUILD_STUDY=OFF \
        "-DMESHLAB_OTHER_SOURCE_DIRS=$others"
      ctest --preset release -j "$tests" ;;
    extras)
      # Each file alone. Benchmarks and study are read too, so that they do not rot, but not built.
      commands_file_by_file -DWSCVT_BUILD_BENCHMARKS=ON -DWSCVT_BUILD_STUDY=ON
      /usr/bin/python3 tests/each_alone.py build/files lib filter_wscvt tests/figures ;;
    nightly)
      # After release: other random bodies every night, and more of them; the bytes of older processors.
      tests/scripts/same_bytes_test.sh build/release/lib/wscvt older-processor meshes build/same_bytes every-grain
      WSCVT_PROPERTY_SEED=$(date +%Y%m%d) WSCVT_PROPERTY_COUNT=4000 build/release/tests/property_tests ;;
    sanitizers)
      configure_and_build asan-ubsan -DCMAKE_CXX_FLAGS_NONE=
      ctest --preset asan-ubsan -j "$tests" ;;
    replay)
      # Of the sanitizers, what was found by fuzzing, the rooms that read what users bring, and those
      # of seeds and nodes, which keep references to what they are given: minutes instead of an hour. The checks of
      # null pointers and alignment at each access, a third of the compilation, are left to the step sanitizers: the
      # address sanitizer sees a null pointer that is used, -Wcast-align=strict a cast that may misalign.
      configure asan-ubsan -DCMAKE_CXX_FLAGS_NONE=-fno-sanitize=null,alignment
      cmake --build --preset asan-ubsan -j "$jobs" --target \
        replay_mesh_file replay_coefficient_file replay_soup replay_remesh replay_volume_file \
        base_tests sphere_tests mesh_files_tests repair_tests exchange_tests tessellation_tests nodes_tests
      ctest --preset asan-ubsan -j "$tests" -R '^replay_'
      ctest --preset asan-ubsan -j "$tests" -L '^(base|sphere|mesh_files|repair|exchange|tessellation|nodes)$' ;;
    format)
      sources lib filter_wscvt tests meshes | xargs clang-format --dry-run -Werror ;;
    tidy)
      # With a newer host, whose own file would be read without its commands otherwise.
      commands_file_by_file "-DMESHLAB_OTHER_SOURCE_DIRS=$newer_source"
      # Of what is built: the examples are built elsewhere, and clang-tidy fails at a command that it guesses.
      sed -n 's/^ *"file": "\(.*\)",*$/\1/p' build/files/compile_commands.json | sort -u |
        grep -E "^$PWD/(lib|filter_wscvt)/" | xargs -P "$jobs" -n 1 clang-tidy --quiet -p build/files
      # What extras does for the library.
      /usr/bin/python3 tests/each_alone.py build/files tests meshes ;;
    docs)
      # Pages of the C++ interface; a warning is an error.
      tests/install_packages.sh doxygen
      configure release
      cmake --build --preset release --target docs ;;
    page)
      # After release. A step of its own, because a browser is 300 MB.
      tests/install_packages.sh chromium poppler-utils
      tests/page_in_browser.sh build/release/lib/wscvt build/page ;;
    web)
      # After release. A step of its own, because emscripten and a browser are 1 GB.
      tests/install_packages.sh emscripten chromium chromium-driver firefox-esr python3-selenium python3-numpy
      lib/web/build.sh build/wscvt-page
      /usr/bin/python3 tests/web_in_browser.py build/release/lib/wscvt build/wscvt-page meshes build/web-pictures ;;
    static)
      # After release; as root, for debootstrap. A step of its own, because ITK's source is 280 MB.
      tests/install_packages.sh debootstrap
      packages/make_static.py build/release build/wscvt-static
      tests/static.sh build/release/lib/wscvt build/wscvt-static meshes build/static ;;
    wine)
      # After release. A step of its own, because wine is 1 GB and the program is built once more.
      tests/install_packages.sh g++-mingw-w64-x86-64-posix libz-mingw-w64-dev wine wine64 python3-numpy
      packages/windows/libraries.sh
      cmake --preset windows -DWSCVT_WARNINGS_AS_ERRORS=ON
      cmake --build --preset windows -j "$jobs"
      tests/wine.sh build/release/lib/wscvt build/windows/lib/wscvt.exe meshes build/wine ;;
    engines)
      # After release. Yade, LIGGGHTS, LAMMPS, Gmsh and VTK are 1 GB, so a step of its own.
      tests/install_packages.sh yade liggghts lammps gmsh calculix-ccx python3-vtk9 python3-numpy python3-scipy libmujoco-dev \
        libbullet-dev python3-matplotlib
      tests/engines/run.sh build/release/lib/wscvt build/engines ;;
    package)
      # After release. A step of its own, because it installs and removes packages of the system.
      tests/install_packages.sh lintian appstream
      tests/packages.sh build/release build/packages ;;
    debian-source)
      # As root, for debootstrap.
      tests/install_packages.sh debootstrap debhelper dh-python lintian autopkgtest
      tests/debian_source.sh build/debian-source ;;
    pip)
      # After release, whose program the module is held against. A step of its own, because pip builds
      # the whole library anew.
      tests/install_packages.sh python3-pip python3-venv python3-setuptools python3-wheel
      tests/python_install.sh build/release/lib/wscvt build/pip ;;
    types)
      # After release. A step of its own, because mypy is not needed elsewhere.
      tests/install_packages.sh mypy
      # The type stub of the Python module, on code that uses it right and wrong.
      MYPYPATH=build/release/lib/python /usr/bin/python3 -m mypy --strict --warn-unused-ignores \
        --cache-dir build/release/mypy tests/python/typed_use.py ;;
    wheel)
      # After release; as root, for debootstrap: the roots have nothing but Python and NumPy.
      tests/install_packages.sh debootstrap patchelf binutils python3-pip python3-venv
      tests/wheel.sh build/release build/wheel ;;
    blender)
      # After release. A step of its own, because Blender is 1 GB.
      tests/install_packages.sh blender patchelf binutils xvfb xauth xdotool libgl1-mesa-dri
      tests/blender.sh build/release build/blender ;;
    blender13)
      # After blender; as root.
      tests/install_packages.sh debootstrap
      tests/blender_debian13.sh build/blender/wscvt-*-blender.zip build/blender13 ;;
    release-files)
      # After release; as root, for debootstrap.
      tests/install_packages.sh debootstrap patchelf binutils xz-utils xvfb
      tests/release_files.sh build/release build/release-files build/release-test ;;
    slurm)
      # After release; as root.
      tests/install_packages.sh slurm-wlm parallel
      tests/slurm.sh build/release/lib/wscvt build/slurm ;;
    workflow)
      # After release.
      tests/install_packages.sh snakemake graphviz python3-numpy
      tests/workflow.sh build/release/lib/wscvt build/workflow ;;
    windows)
      # After release; as root.
      tests/install_packages.sh debootstrap
      tests/windows.sh build/release trixie
      tests/windows.sh build/release sid ;;
    debian12)
      tests/install_packages.sh debootstrap
      tests/debian_tree.sh bookworm ;;
    debian13)
      tests/install_packages.sh debootstrap
      tests/debian_tree.sh trixie ;;
    sid)
      tests/install_packages.sh debootstrap
      tests/debian_tree.sh sid ;;
    *)
      echo "Unknown step $step" >&2
      exit 2 ;;
  esac
done
echo "All checks passed."
