#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the plugin and remeshes a sample with it through meshlabserver, from nothing but a bare
# Debian 12; the log is what meshlabserver prints.
#   filter_wscvt/demo.sh [MESH [SCRIPT [OUTPUT]]]
set -eu
mesh=$(realpath "${1:-$(dirname "$0")/../meshes/sand_7228.ply}")
script=$(realpath "${2:-$(dirname "$0")/wscvt_d.mlx}")
cd "$(dirname "$0")/.."
output=$(realpath -m "${3:-build/remeshed.ply}")

tests/install_packages.sh
filter_wscvt/get_meshlab_source.sh "$PWD/build/meshlab-source"
cmake --preset release -DMESHLAB_SOURCE_DIR="$PWD/build/meshlab-source"
cmake --build --preset release --target wscvt_stage

rm -f "$output"
# meshlabserver ends with 0 even when it could not save, and xvfb-run has codes of its own.
xvfb-run -a build/release/filter_wscvt/stage/bin/meshlabserver \
  -i "$mesh" -s "$script" -o "$output" -m vq vc 2>/dev/null || true
test -s "$output" || {
  echo "meshlabserver wrote no mesh; the reason stands above." >&2
  exit 1
}
echo "The mesh is in $output."
