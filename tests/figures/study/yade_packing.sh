#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes packings in Yade for several choices of nodes, from paired starts; see yade_packing.py.
#   tests/figures/study/yade_packing.sh PROGRAM FOLDER SEEDS [NODES:PLACEMENT[:WEIGHTING]...]
# PROGRAM is wscvt. tests/run_all.sh engines installs the packages. packings.txt gets one line per packing;
# packing_table.py FOLDER makes a table of them. SHAPE="SIDE LAYERS SECONDS" is 3 6 1 if not set. The paper's
# figures 11 to 13 with 100 grains, WSCVT-D and WSCVT-C:
#   SHAPE="5 4 1" tests/figures/study/yade_packing.sh PROGRAM FOLDER 5 7228:on-surface \
#     100:on-surface:wscvt-d 500:on-surface:wscvt-d 1000:on-surface:wscvt-d \
#     100:on-surface:wscvt-c 500:on-surface:wscvt-c 1000:on-surface:wscvt-c
set -eu
program=$(realpath "${1:?usage: yade_packing.sh PROGRAM FOLDER SEEDS [NODES:PLACEMENT[:WEIGHTING]...]}")
folder=$(realpath -m "${2:?usage: yade_packing.sh PROGRAM FOLDER SEEDS [NODES:PLACEMENT[:WEIGHTING]...]}")
seeds=$(seq "${3:?usage: yade_packing.sh PROGRAM FOLDER SEEDS [NODES:PLACEMENT[:WEIGHTING]...]}")
shift 3
[ $# -gt 0 ] || set -- 7228:on-surface 100:on-surface 500:on-surface 1000:on-surface 100:fitted 200:fitted 200:contact-fit
here=$(realpath "$(dirname "$0")")
mkdir -p "$folder"
cd "$folder"
# The reference of the packings: as many nodes on the scan as it has vertices.
"$program" remesh -q "$here/../../../meshes/sand_7228.ply" vertices.ply -n 7228 -p on-surface \
  --frame principal --size 0.1 --node-table vertices.csv --sdf vertices.npy
for set in "$@"; do
  IFS=: read -r nodes placement weighting << END
$set
END
  name=$placement${weighting:+-$weighting}_$nodes
  "$program" remesh -q "$here/../../../meshes/sand_7228.ply" "$name.ply" -n "$nodes" -p "$placement" \
    ${weighting:+-w "$weighting"} \
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
  for set in "$@"; do
    options=$(echo "${set#*:}" | tr : -)
    echo "$options ${options}_${set%%:*} $seed"
  done
done | SHAPE=${SHAPE-3 6 1} xargs -P "${JOBS:-$(nproc)}" -L 1 sh -c '
  log=$2_$3.log
  yade -n -x "$0/yade_packing.py" "$2.csv" "$2.npy" "$3" "$2_$3.csv" $SHAPE > "$log" 2>&1 ||
    { tail -n 20 "$log" >&2; exit 255; }
  echo "$1 $(grep "^Yade packing" "$log")" | tee -a packings.txt' "$here"
