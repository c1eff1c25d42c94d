#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the program and another one, and compares their files byte by byte: both methods, all weightings,
# placements, clump, convex, fragment, grow, templates, segment, contacts, extract, conforming walls, engines' folders and
# reports. OTHER is a program, or older-processor for the same program as on a processor on which glibc takes other variants
# of its mathematical functions. A build without ITK has no segment; it is given the labels.
#   same_bytes_test.sh PROGRAM OTHER MESHES WORK_FOLDER [every-grain | without-segment]
set -eu
program=$(realpath "$1")
other=$2
[ "$other" = older-processor ] || other=$(realpath "$2")
meshes=$(realpath "$3")
rm -rf "$4"
mkdir -p "$4"
work=$(realpath "$4")
grains="sand_7228 angular_6000 elongated_rough_8000"
if [ "${5:-}" = every-grain ]; then
  grains=$(cd "$meshes" && ls ./*.ply | sed 's/.ply$//; s/^..//')
fi

segments=yes
[ "${5:-}" != without-segment ] || segments=no

wscvt() {
  "$program" "$@" --threads 1 > "$work/log" 2>&1 || {
    cat "$work/log" >&2
    exit 1
  }
}

make_all() {  # folder
  mkdir "$1"
  cd "$1"
  for grain in $grains; do
    for weighting in wscvt-d wscvt-c; do
      wscvt remesh "$meshes/$grain.ply" "$grain-$weighting.ply" -q -n 300 -w "$weighting" \
        --report "$grain-$weighting.json"
    done
    for weighting in wscvt-d wscvt-c area; do
      wscvt remesh "$meshes/$grain.ply" "$grain-$weighting-published.ply" -q -n 300 --method as-published -d 12 \
        -w "$weighting" --coefficients "$grain-$weighting-published.json"
    done
    wscvt describe "$grain-wscvt-c.ply" -q --report "$grain-shape.json"
  done
  wscvt remesh "$meshes/sand_7228.ply" contact.ply -q -n 300 -p contact-fit --edge-ratio 1.4 \
    --report contact.html
  wscvt clump contact.ply --output clump.csv -q -k 12
  wscvt convex contact.ply --output parts.obj -q -k 4
  wscvt clump contact.ply -o lammps -q -k 5 --engine lammps
  wscvt convex contact.ply -o yade -q -k 1 --faces 40 --engine yade
  wscvt fragment contact.ply -o fragments -q -k 5 -n 80
  # Growing needs eight grains.
  for nodes in 150 200; do
    wscvt batch "$meshes" -o $nodes -q -n $nodes
  done
  wscvt grow 150 200 -o grown -q -k 4 -n 100 --degree 8
  wscvt grow 150 --templates -o templates -q -k 4
  wscvt sample 150 -q --report sample.json
  wscvt create superellipsoid rod.stl --semi-axes 3 1 0.5 --exponents 0.7 1 -q -n 200
  cp "$work/scan.tif" .
  if [ "$segments" = yes ]; then
    wscvt segment scan.tif labels.nrrd -q
  else
    cp "$work/labels.nrrd" .
  fi
  wscvt batch labels.nrrd -o extracted -q -n 100
  wscvt describe labels.nrrd scan.tif -o contacts -q
  wscvt extract labels.nrrd walls -q -n 100
}

# Two balls that touch, 60 x 32 x 32 voxels of one byte.
python3 - "$(dirname "$(realpath "$0")")/../texts" "$work/scan.tif" << 'END'
import sys
sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import run_readme
with open(sys.argv[2], "wb") as file:
    file.write(run_readme.tiff((20, 200, 200)))
END
[ "$segments" = yes ] || "$program" segment "$work/scan.tif" "$work/labels.nrrd" -q
make_all "$work/here"
if [ "$other" = older-processor ]; then
  export GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4,-AVX
else
  program=$other
fi
make_all "$work/there"
cd "$work"
diff -rq here there || {
  echo "$other gives other bytes. Is there a call of std::cos or the like outside of" \
    "wscvt/base/portable_math.h, in a library perhaps?" >&2
  exit 1
}
echo "$(find here -type f | wc -l) files have the same bytes."
rm -rf here there
