#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds everything and passes every test: all tests in release with warnings as errors, most of
# them again under the address and undefined-behaviour sanitizers, and formatting.
#   tests/run_all.sh [install] [release] [sanitizers] [format] [tidy]
# Without arguments: all but tidy, in this order; the static analysis takes half as long as all the
# rest. The sanitized build goes without CGAL's own assertions (CGAL_NDEBUG), which make some tests a
# hundred times slower; those of Eigen and OpenMesh stay.
set -eu
cd "$(dirname "$0")/.."
jobs=$(nproc)
meshlab_source=$PWD/build/meshlab-source

sources() { find "$@" \( -name '*.h' -o -name '*.cpp' \) | sort; }

configure_and_test() {  # preset, more options
  preset=$1
  shift
  cmake --preset "$preset" -DWSCVT_WARNINGS_AS_ERRORS=ON -DMESHLAB_SOURCE_DIR="$meshlab_source" "$@"
  cmake --build --preset "$preset" -j "$jobs"
  ctest --preset "$preset" -j "$jobs"
}

[ $# -gt 0 ] || set -- install release sanitizers format
for step in "$@"; do
  echo "== $step"
  case $step in
    install)
      tests/install_packages.sh
      filter_wscvt/get_meshlab_source.sh "$meshlab_source" ;;
    release)
      # Benchmarks and study are built, so that they do not rot, but not run.
      configure_and_test release -DWSCVT_BUILD_BENCHMARKS=ON -DWSCVT_BUILD_STUDY=ON ;;
    sanitizers)
      configure_and_test asan-ubsan ;;
    format)
      sources lib filter_wscvt tests meshes | xargs clang-format --dry-run -Werror ;;
    tidy)
      # After release, whose compile commands it reads.
      sources lib filter_wscvt | grep '\.cpp$' |
        xargs -P "$jobs" -n 1 clang-tidy --quiet -p build/release ;;
    *)
      echo "Unknown step $step" >&2
      exit 2 ;;
  esac
done
echo "All checks passed."
