#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes packings in Yade for several choices of nodes, from paired starts; see yade_packing.py.
#   tests/figures/study/yade_packing.sh PROGRAM FOLDER SEEDS [NODES:PLACEMENT...]
# PROGRAM is wscvt. tests/run_all.sh engines installs the packages. packings.txt gets one line per packing;
# packing_table.py FOLDER makes a table of them.
set -eu
program=$(realpath "${1:?usage: yade_packing.sh PROGRAM FOLDER SEEDS [NODES:PLACEMENT...]}")
folder=$(realpath -m "${2:?usage: yade_packing.sh PROGRAM FOLDER SEEDS [NODES:PLACEMENT...]}")
seeds=$(seq "${3:?usage: yade_packing.sh PROGRAM FOLDER SEEDS [NODES:PLACEMENT...]}")
shift 3
[ $# -gt 0 ] || set -- 7228:on-surface 100:on-surface 500:on-surface 1000:on-surface 100:fitted 200:fitted 200:contact-fit
here=$(realpath "$(dirname "$0")")
mkdir -p "$folder"
cd "$folder"
# The reference of the packings: as many nodes on the scan as it has vertices.
"$program" remesh -q "$here/../../../meshes/sand_7228.ply" vertices.ply -n 7228 -p on-surface \
  --frame principal --size 0.1 --node-table vertices.csv --sdf vertices.npy
for set in "$@"; do
  nodes=${set%:*}
  placement=${set#*:}
  name=${placement}_$nodes
  "$program" remesh -q "$here/../../../meshes/sand_7228.ply" "$name.ply" -n "$nodes" -p "$placement" \
    --frame principal --size 0.1 --node-table "$name.csv" --sdf "$name.npy"
done
# Without damping and friction the packing must keep its energy: else the law makes some in those below too.
"$program" remesh -q "$here/../../../meshes/sand_7228.ply" undamped.ply -n 100 -p on-surface \
  --frame principal --size 0.1 --node-table undamped.csv --sdf undamped.npy
for law in contacts own; do
  yade -n -x "$here/yade_packing.py" undamped.csv undamped.npy 1 undamped.energies 3 6 1 0 0 "$law" \
    > undamped.log 2>&1 || {
    tail -n 20 undamped.log >&2
    exit 1
  }
  grep '^Yade undamped' undamped.log
done
# Seed by seed, so that a study that is stopped has every set as often, and as many at a time as there
# are cores: one takes a minute for every 600 nodes.
for seed in $seeds; do
  for set in "$@"; do echo "${set#*:} ${set#*:}_${set%:*} $seed"; done
done | xargs -P "$(nproc)" -L 1 sh -c '
  log=$2_$3.log
  yade -n -x "$0/yade_packing.py" "$2.csv" "$2.npy" "$3" "$2_$3.csv" > "$log" 2>&1 ||
    { tail -n 20 "$log" >&2; exit 255; }
  echo "$1 $(grep "^Yade packing" "$log")" | tee -a packings.txt' "$here"
