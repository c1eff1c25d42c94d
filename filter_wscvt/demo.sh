#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the plugin on a bare Debian 12 or 13, remeshes an example grain, and builds the program and the Python
# module. On 12 meshlabserver runs the filter, and its log is printed. MeshLab of 13 has no meshlabserver: there
# the program remeshes, and MeshLab's window shows the filter, in pictures beside the mesh.
#   filter_wscvt/demo.sh [MESH [SCRIPT [OUTPUT]]]     (SCRIPT: for meshlabserver)
set -eu
mesh=$(realpath "${1:-$(dirname "$0")/../meshes/sand_7228.ply}")
script=$(realpath "${2:-$(dirname "$0")/wscvt_d.mlx}")
root=$(realpath "$(dirname "$0")/..")
output=$(realpath -m "${3:-$root/build/remeshed.ply}")
cd "$root"
# One run at a time: two would build in one folder.
exec 9< "$root/filter_wscvt/demo.sh"
flock 9

step() { printf '\n== %s\n' "$1"; }
build() { cmake --build --preset release --target "$@"; }

step "Installing the Debian packages that are missing, and MeshLab's headers"
tests/install_packages.sh
filter_wscvt/get_meshlab_source.sh "$PWD/build/meshlab-source"
# The same options as in tests/run_all.sh, which then need not build the library again. With a compiler that
# was never tested, a warning is no reason to stop.
case $(c++ -dumpversion) in
  12 | 14) strict=ON ;;
  *) strict=OFF ;;
esac
step "Configuring the build in $PWD/build/release"
cmake --preset release -DMESHLAB_SOURCE_DIR="$PWD/build/meshlab-source" -DWSCVT_WARNINGS_AS_ERRORS=$strict
stage=$PWD/build/release/filter_wscvt/stage
if command -v meshlabserver > /dev/null; then
  step "Building the library and MeshLab's plugin, some minutes"
  build wscvt_stage
else
  step "Building the library, MeshLab's plugin and the program, some minutes"
  build wscvt_stage wscvt_program
fi

# The file appears under its name when it is whole; the old file stays until then. The temporary folder beside
# it has a fixed name, so that the next run finds the remains of a killed run.
work=$output.part
mkdir -p "$(dirname "$output")"
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM
trap 'rm -rf "$work"' EXIT
rm -rf "$work"
mkdir "$work"
made=$work/$(basename "$output")
step "Remeshing $mesh"
if command -v meshlabserver > /dev/null; then
  # meshlabserver ends with 0 even when it could not save, and xvfb-run has codes of its own.
  xvfb-run -a "$stage/bin/meshlabserver" \
    -i "$mesh" -s "$script" -o "$made" -m vq vc 2> "$work/messages" || true
  test -s "$made" || {
    cat "$work/messages" >&2
    echo "meshlabserver wrote no mesh. See its messages above." >&2
    exit 1
  }
else
  build/release/lib/wscvt "$mesh" "$made" -n 1000
  pictures=${output%.*}
  xvfb-run -a -s "-screen 0 1280x1000x24" filter_wscvt/show_filter.sh \
    filter_wscvt/open_meshlab.sh "$mesh" "$work/filter.png" "$work/result.png"
  mv -T "$work/filter.png" "$pictures-filter.png"
  mv -T "$work/result.png" "$pictures-result.png"
  echo "The filter's dialog and its result are in $pictures-filter.png and $pictures-result.png."
fi
mv -T "$made" "$output"
echo "The mesh is in $output."
step "Building the program, the Python module and the rest that cmake --install wants"
build wscvt_program_texts wscvt_python wscvt_c
echo "The program is build/release/lib/wscvt. filter_wscvt/open_meshlab.sh opens MeshLab with the plugin."
