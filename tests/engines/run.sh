#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Loads a grain into the engines of Debian: Yade (level sets), LIGGGHTS (surface mesh), Gmsh (tetrahedra)
# and VTK (ParaView has the same readers). Runs the examples of lib/examples/engines.
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
      "calculix-ccx lammps libmujoco-dev libbullet-dev python3-vtk9 python3-numpy python3-matplotlib" >&2
    exit 1
  }
done
# Debian's own Python, because Debian's modules are for its version.
python=/usr/bin/python3
mkdir -p "$folder"
cd "$folder"

for nodes in 200 1000; do
  "$program" remesh -q "$here/../../meshes/sand_7228.ply" "grain_$nodes.stl" -n "$nodes" \
    --frame principal --size 0.1 --sdf-surface remesh \
    --node-table "nodes_$nodes.csv" --node-table "nodes_$nodes.vtp" --node-table "grain_$nodes.shp" \
    --sdf "grid_$nodes.npy" --sdf "grid_$nodes.vti"
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

# CalculiX presses a ball. Its force is that of Hertz but for the rough plates and the linear elements.
"$program" create ellipsoid ball.ply -q -n 4000
"$program" remesh -q ball.ply ball_500.ply -n 500 --tetrahedra ball.inp --tetrahedra-edge 0.3
"$python" "$here/../../lib/examples/compression.py" ball.inp --by 5 | tee compression.log
awk '{ hertz = 4 / 3 / (1 - 0.25 ^ 2) * 0.05 ^ 1.5
       exit !($2 > hertz && $2 < 1.5 * hertz && ($2 - $7) ^ 2 < (1e-6 * $2) ^ 2) }' compression.log

# Templates of nine bodies, packed by the files that stand beside them.
mkdir -p bodies
for k in 1 2 3 4 5 6 7 8 9; do
  "$program" create superellipsoid "bodies/body_$k.ply" -q -n 300 \
    --semi-axes "1.$k" 1 "0.$((12 - k))" --polar-exponent "0.$((2 + k))"
done
"$program" templates bodies -o templates -q -k 3 -n 100
(cd templates && yade -n -x yade_packing.py 12 > yade.log 2>&1) || {
  tail -n 30 templates/yade.log >&2
  exit 1
}
grep '^Packed 12 grains' templates/yade.log
(cd templates && sed 's/^variable grains equal .*/variable grains equal 20/' liggghts.in > packing.in &&
  liggghts -in packing.in > liggghts.out 2>&1) || {
  tail -n 30 templates/liggghts.out >&2
  exit 1
}
"$python" "$here/liggghts_packing_test.py" templates/packing.in templates/liggghts.out 20
# The document's own commands: 20 templates, and 500 virtual grains, packed.
sh "$here/growing.sh" "$program" "$folder/growing"

# The examples, from scans to a packing at rest. One of the scans is broken, and names have spaces.
examples=$here/../../lib/examples/engines
mkdir -p "my scans"
cp "$here/../../meshes/sand_5658.ply" "$here/../../meshes/angular_6000.ply" "my scans"
head -c 20000 "$here/../../meshes/sand_5658.ply" > "my scans/broken scan.ply"
example() {  # its script, its heading, grains
  case $1 in yade*) run="yade -n -x" ;; *) run=$python ;; esac
  usage=$($run "$examples/$1.py" 2>&1) && exit 1
  echo "$usage" | grep -q "$1.py SCANS"
  rm -f "$1.png"
  WSCVT=$program $run "$examples/$1.py" "my scans" "$3" > "$1.log" 2>&1 || {
    tail -n 30 "$1.log" >&2
    exit 1
  }
  grep -q '^Left out: my scans/broken scan.ply' "$1.log"
  grep "^$2: $3 grains.* 0\.00.. m/s at most" "$1.log"
  test -s "$1.png"
}
example yade_polyhedra "Yade polyhedra" 6
example yade_level_set "Yade level sets" 8
example yade_clumps "Yade clumps" 8
example liggghts_clumps "LIGGGHTS clumps" 8
example lammps_clumps "LAMMPS clumps" 8
example mujoco_packing MuJoCo 8
example bullet_packing Bullet 8
# LAMMPS moves grains with the mass and moments of the file, and not of the spheres.
"$python" << END
def head(path, word):
    line, = [line for line in open(path) if line.endswith(" %s\n" % word)]
    return [float(v) for v in line.split()[:-1] if float(v) != 0]
files = [head("clump_%d.molecule" % k, "mass") + sorted(head("clump_%d.molecule" % k, "inertia")) for k in (0, 1)]
grains = [line.split() for line in open("lammps_grains.dump").read().rpartition("ITEM: ENTRIES")[2].splitlines()[1:]]
assert len(grains) == 8
for grain in grains:
    moved = [float(grain[1])] + sorted(float(v) for v in grain[8:11])
    # The dump has six digits.
    assert any(all(abs(a / b - 1) < 1e-5 for a, b in zip(moved, file)) for file in files), (moved, files)
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
