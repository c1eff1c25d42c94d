#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Loads a grain into the engines of Debian: Yade (level sets), LIGGGHTS (surface mesh), Gmsh (tetrahedra)
# and VTK (ParaView has the same readers). Packs grains in the folders that --engine makes.
#   tests/engines/run.sh PROGRAM FOLDER
# PROGRAM is wscvt. Leaves the files in FOLDER. tests/run_all.sh engines runs it and installs the large
# packages.
set -eu
program=$(realpath "${1:?usage: run.sh PROGRAM FOLDER}")
folder=$(realpath -m "${2:?usage: run.sh PROGRAM FOLDER}")
here=$(realpath "$(dirname "$0")")
for command in yade liggghts gmsh lmp ccx; do
  command -v "$command" > /dev/null || {
    echo "$command is not installed; run: apt-get install --no-install-recommends yade liggghts gmsh" \
      "calculix-ccx lammps libmujoco-dev libbullet-dev python3-vtk9 python3-numpy python3-scipy python3-matplotlib" >&2
    exit 1
  }
done
# Debian's own Python, because Debian's modules are for its version.
python=/usr/bin/python3
mkdir -p "$folder"
cd "$folder"

for nodes in 200 1000; do
  "$program" remesh -q "$here/../../meshes/sand_7228.ply" "grain_$nodes.stl" -n "$nodes" \
    --frame principal --size 0.1 \
    --node-table "nodes_$nodes.csv" --node-table "nodes_$nodes.vtp" --node-table "grain_$nodes.shp"
  # The program's grids have distances to the scan. VTK knows only the remesh.
  PYTHONPATH=$(dirname "$program")/python "$python" - "$here/../../meshes/sand_7228.ply" "$nodes" << 'END'
import sys, wscvt
remesh = wscvt.remesh(sys.argv[1], int(sys.argv[2]))
for ending in "npy", "vti":
    remesh.write_signed_distances("grid_%s.%s" % (sys.argv[2], ending), surface="remesh", frame="principal", size=0.1)
END
  "$python" "$here/vtk_test.py" "nodes_$nodes.csv" "nodes_$nodes.vtp" "grid_$nodes.npy" \
    "grid_$nodes.vti"
  yade -n -x "$here/yade_test.py" "nodes_$nodes.csv" "grid_$nodes.npy" > "yade_$nodes.log" 2>&1 || {
    tail -n 30 "yade_$nodes.log" >&2
    exit 1
  }
  grep '^Yade:' "yade_$nodes.log"

  # Gmsh fills the closed surface with tetrahedra; their volume must be the body's.
  cat > "grain_$nodes.geo" << END
Merge "grain_$nodes.stl";
Surface Loop(1) = {1};
Volume(1) = {1};
END
  gmsh -3 -format msh2 -o "grain_$nodes.msh" "grain_$nodes.geo" > "gmsh_$nodes.log" 2>&1
  "$python" "$here/gmsh_test.py" "grain_$nodes.msh" "grid_$nodes.npy.json"

  # LIGGGHTS reads the surface as a mesh of walls, and refuses one with holes or slivers.
  sed "s/GRAIN/grain_$nodes.stl/" "$here/liggghts_test.in" > "liggghts_$nodes.in"
  # With its output in a file: without any (-screen none) it reads from no pointer and crashes.
  liggghts -in "liggghts_$nodes.in" -log "liggghts_$nodes.log" > "liggghts_$nodes.out" 2>&1
  "$python" "$here/liggghts_test.py" "liggghts_$nodes.out" "$((2 * nodes - 4))"
done

# CalculiX presses a ball. 500 nodes and linear elements make it 12 % stiffer than it is.
"$program" create ellipsoid ball.ply -q -n 4000
"$program" remesh -q ball.ply ball_500.ply -n 500 --tetrahedra ball.inp --edge-length 0.3
"$python" "$here/../../lib/examples/compression.py" ball.inp --by 5 | tee compression.log
"$python" "$here/../figures/study/pressed_ball.py" | grep "by 5 %, rough" | tee pressed_ball.log
awk 'FNR == NR { known = $7 + 0; next }
     { exit !($2 > known && $2 < 1.15 * known && ($2 - $7) ^ 2 < (1e-6 * $2) ^ 2) }' pressed_ball.log compression.log

# The document's own commands: 20 templates, and 500 virtual grains, packed.
sh "$here/growing.sh" "$program" "$folder/growing"

# From scans to a packing at rest. One of the scans is broken, and names have spaces and a comma.
mkdir -p "my scans"
cp "$here/../../meshes/sand_5658.ply" "my scans/sand, 5658.ply"
cp "$here/../../meshes/angular_6000.ply" "my scans"
head -c 20000 "$here/../../meshes/sand_5658.ply" > "my scans/broken scan.ply"
printf 'diameter,finer\n0.01,0\n0.02,60\n0.03,100\n' > curve.csv
packing() {  # folder, heading, grains, lower and upper limit of the porosity, call
  folder=$1 heading=$2 grains=$3 low=$4 high=$5
  shift 5
  rm -rf "$folder"
  # Exit code 3, because of the broken scan.
  "$program" "$@" -o "$folder" -q 2> "$folder.errors" && exit 1
  [ -z "${container-}" ] || sed -i "s/\"shape\": \"box\"/\"shape\": \"$container\"/" "$folder/scene.json"
  case $heading in Yade) run="yade -n -x" ;; *) run=$python ;; esac
  (cd "$folder" && $run run.py "$grains" > run.log 2>&1) || {
    tail -n 30 "$folder/run.log" >&2
    exit 1
  }
  grep "^$heading: $grains grains at rest" "$folder/run.log" || {
    tail -n 5 "$folder/run.log" >&2
    exit 1
  }
  sed -n 's/.* porosity \([0-9.]*\), .*/\1/p' "$folder/run.log" |
    awk -v low="$low" -v high="$high" '$1 < low || $1 > high { print "porosity", $1, "of", low, "to", high; exit 1 }' >&2
  test -s "$folder/packing.png"
  test "$(wc -l < "$folder/packing.csv")" = $((grains + 1))
}
# Random packings of grains with friction have .4 to .55. Walls add to it: three grains fit side by side here. A scene has
# no unit of its own: fine sand in metres and gravel in millimetres come to rest too.
packing yade_clumps Yade 40 .4 .65 clump "my scans" -k 10 --size 0.02 --engine yade
container=cylinder packing yade_sizes Yade 120 .4 .65 clump "my scans" -k 10 --size-curve curve.csv --engine yade
packing yade_polyhedra Yade 6 .4 .85 convex "my scans" -k 1 --faces 30 --size 0.0005 --engine yade
# One mesh, 100 nodes and a grid of distances each, with the law of yade_level_sets.py.
packing yade_level_sets Yade 20 .4 .8 batch "my scans" -n 100 --size 20 --engine yade
packing yade_level_sizes Yade 20 .4 .85 batch "my scans" -n 100 --size-curve curve.csv --engine yade
packing lammps LAMMPS 120 .4 .65 clump "my scans" -k 10 --size-curve curve.csv --engine lammps
container=cylinder packing liggghts LIGGGHTS 40 .4 .65 clump "my scans" -k 10 --size 0.0001 --engine liggghts
packing mujoco MuJoCo 40 .4 .65 convex "my scans" -k 4 -n 300 --faces 60 --size 0.02 --engine mujoco
container=cylinder packing bullet Bullet 40 .4 .65 convex "my scans" -k 4 -n 300 --faces 60 --size 0.02 --engine bullet
# Sizes of the packing follow the curve: 60 % of the mass is finer than 0.02. One of 120 grains has up to 3 %.
"$python" - << END
import csv
sizes = [float(row["equivalent_diameter"]) for row in csv.DictReader(open("lammps/packing.csv"))]
finer = sum(d ** 3 for d in sizes if d < 0.02) / sum(d ** 3 for d in sizes)
assert min(sizes) >= 0.01 and max(sizes) <= 0.03 and abs(finer - 0.6) < 0.05, finer
END
# LAMMPS moves grains with the mass and moments of the grains, and not of their spheres.
"$python" - << END
given = [[float(v) for v in line.split()] for line in open("lammps/packing.bodies").read().splitlines()[1:]]
text = open("lammps/packing.grains").read().rpartition("ITEM: ENTRIES")[2]
moved = sorted(([float(v) for v in line.split()[1:]] for line in text.splitlines()[1:]), key=lambda row: row[0])
assert len(moved) == len(given) == 120
for a, b in zip(given, moved):
    # The moments' sum is the trace, in any axes. The dump has six digits.
    for mine, theirs in ((a[1], b[4]), (sum(a[5:8]), sum(b[5:8]))):
        assert abs(mine / theirs - 1) < 1e-5, (a, b)
END

# A clump of the grain: LIGGGHTS and Yade drop it on a wall.
"$program" clump -q "$here/../../meshes/sand_7228.ply" -k 20 --size 0.05 -o clump.multisphere -o clump.py \
  --report clump.json
liggghts -in "$here/clump_test.in" -log clump_liggghts.log > clump_liggghts.out 2>&1 || {
  tail -n 20 clump_liggghts.out >&2
  exit 1
}
"$python" - clump_liggghts.out << END
import re, sys
rows = [line.split() for line in open(sys.argv[1]) if re.match(r" *20000 ", line)]
assert rows and int(rows[0][1]) == 20 and float(rows[0][3]) > -0.02, rows
print("LIGGGHTS: clump of %s spheres, centres at %.3f m or above" % (rows[0][1], float(rows[0][3])))
END
yade -n -x "$here/clump_yade_test.py" > clump_yade.log 2>&1 || {
  tail -n 30 clump_yade.log >&2
  exit 1
}
grep '^Yade: clump' clump_yade.log
echo "The engines take the grain."
