#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds everything and passes every test: all tests in release with warnings as errors, the tests
# again under the address and undefined-behaviour sanitizers, and formatting.
#   tests/run_all.sh [install] [release] [sanitizers] [format] [tidy]
# Without arguments: all but tidy, in this order; the static analysis takes half as long as all the
# rest. The sanitized build goes without CGAL's own assertions (CGAL_NDEBUG), which make some tests a
# hundred times slower; those of Eigen and OpenMesh stay.
set -eu
cd "$(dirname "$0")/.."
jobs=$(nproc)
meshlab_source=$PWD/build/meshlab-source

sources() { find "$@" \( -name '*.h' -o -name '*.cpp' \) | sort; }

configure_and_test() {
  cmake --preset "$1" -DWSCVT_WARNINGS_AS_ERRORS=ON -DMESHLAB_SOURCE_DIR="$meshlab_source"
  cmake --build --preset "$1" -j "$jobs"
  ctest --preset "$1" -j "$jobs"
}

[ $# -gt 0 ] || set -- install release sanitizers format
for step in "$@"; do
  echo "== $step"
  case $step in
    install)
      tests/install_packages.sh
      filter_wscvt/get_meshlab_source.sh "$meshlab_source" ;;
    release)
      configure_and_test release ;;
    sanitizers)
      configure_and_test asan-ubsan ;;
    format)
      sources lib filter_wscvt tests | xargs clang-format --dry-run -Werror ;;
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
