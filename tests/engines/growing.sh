#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the commands of lib/doc/grow.md, word for word: templates, virtual grains and their packing in Yade. Then the
# three of lib/doc/tutorial.md from a scan to a packing.
#   tests/engines/growing.sh PROGRAM FOLDER
# Makes FOLDER, with a sample of 28 grains in its folder `scans`. A part of run.sh.
set -eu
program=$1
folder=$2
here=$(realpath "$(dirname "$0")")
mkdir -p "$folder/scans"
cd "$folder"
cp "$here"/../../meshes/sand_*.ply "$here"/../../meshes/angular_*.ply scans
k=0
while [ "$(find scans -type f | wc -l)" -lt 28 ]; do
  k=$((k + 1))
  "$program" create superellipsoid "scans/body_$k.ply" -q -n 300 --semi-axes "1.$((10 + k))" 1 \
    "0.$((92 - k))" --exponents "0.$((70 + k))" 1
done
run_all() {  # those of `commands`, whose packing has this number of grains
  PATH=$(dirname "$program"):$PATH sh -eu commands > growing.log 2>&1 || {
    tail -n 30 growing.log >&2
    exit 1
  }
  grep "^Yade: $1 grains at rest" growing.log
}

sed -n 's/^    \(\(wscvt\|cd\|yade\) .*\)/\1/p' "$here/../../lib/doc/grow.md" > commands
grep -q '^yade .* 500$' commands
run_all 500

/usr/bin/python3 "$here/../../lib/examples/ct_volume.py" scan.npy
sed -n 's/^    build.release.lib.\(wscvt \(segment\|clump\) .*\)/\1/p; s/^    \(cd run .*\)/\1/p' \
  "$here/../../lib/doc/tutorial.md" > commands
test "$(wc -l < commands)" -eq 3
run_all 200
test -s run/packing.png
