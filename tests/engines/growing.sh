#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the commands of lib/doc/grow.md, word for word: templates, virtual grains and their packing in Yade.
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
sed -n 's/^    \(\(wscvt\|cd\|yade\) .*\)/\1/p' "$here/../../lib/doc/grow.md" > commands
grep -q '^yade .* 500$' commands
PATH=$(dirname "$program"):$PATH sh -eu commands > growing.log 2>&1 || {
  tail -n 30 growing.log >&2
  exit 1
}
grep '^Yade: 500 grains' growing.log
