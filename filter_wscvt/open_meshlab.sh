#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Opens MeshLab's window with the plugin that demo.sh built, and with a mesh.
#   filter_wscvt/open_meshlab.sh [MESH]     (by default the example grain)
set -eu
root=$(realpath "$(dirname "$0")/..")
stage=$root/build/release/filter_wscvt/stage
if ! test -x "$stage/bin/meshlab"; then
  echo "The plugin is not built. Run filter_wscvt/demo.sh first." >&2
  exit 1
fi
# Debian unstable's meshlab does not find its library without help.
LD_LIBRARY_PATH=$(dirname "$(readlink -f "$stage"/lib/*/meshlab/libmeshlab-common.so)")
export LD_LIBRARY_PATH
exec "$stage/bin/meshlab" "${1:-$root/meshes/sand_7228.ply}"
