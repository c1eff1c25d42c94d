#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the plugin and remeshes a sample with it through meshlabserver, from nothing but a bare
# Debian 12; the log is what meshlabserver prints.
#   filter_wscvt/demo.sh [MESH [SCRIPT [OUTPUT]]]
set -eu
mesh=$(realpath "${1:-$(dirname "$0")/../meshes/sand_7228.ply}")
script=$(realpath "${2:-$(dirname "$0")/wscvt_d.mlx}")
root=$(realpath "$(dirname "$0")/..")
output=$(realpath -m "${3:-$root/build/remeshed.ply}")
cd "$root"
# One run at a time: two would build in one folder.
exec 9< "$root/filter_wscvt/demo.sh"
flock 9

tests/install_packages.sh
filter_wscvt/get_meshlab_source.sh "$PWD/build/meshlab-source"
cmake --preset release -DMESHLAB_SOURCE_DIR="$PWD/build/meshlab-source"
cmake --build --preset release --target wscvt_stage

# The file appears under its name when it is whole; what was there until then stays. The folder
# beside it has one name, so that what a killed run left is found.
work=$output.part
mkdir -p "$(dirname "$output")"
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM
trap 'rm -rf "$work"' EXIT
rm -rf "$work"
mkdir "$work"
made=$work/$(basename "$output")
# meshlabserver ends with 0 even when it could not save, and xvfb-run has codes of its own.
xvfb-run -a build/release/filter_wscvt/stage/bin/meshlabserver \
  -i "$mesh" -s "$script" -o "$made" -m vq vc 2>/dev/null || true
test -s "$made" || {
  echo "meshlabserver wrote no mesh; the reason stands above." >&2
  exit 1
}
mv -T "$made" "$output"
echo "The mesh is in $output."
