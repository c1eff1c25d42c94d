#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Times whole processes, file to file, in one run: this remesher against MeshLab's own quadric edge
# collapse and isotropic remeshing on the same scan.
#   compare_with_meshlab.sh WSCVT_PROGRAM SCAN.ply [NODES [RUNS]]
# Prints the median wall time and the peak memory of each, and the ratios to wscvt.
set -eu
# One display for all runs, so that starting it is not part of MeshLab's time.
[ -n "${DISPLAY:-}" ] || exec xvfb-run -a "$0" "$@"
program=$1
scan=$2
nodes=${3:-1000}
runs=${4:-3}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat > "$work/collapse.mlx" <<XML
<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Simplification: Quadric Edge Collapse Decimation">
  <Param type="RichInt" name="TargetFaceNum" value="$((2 * nodes - 4))"/>
  <Param type="RichFloat" name="TargetPerc" value="0"/>
  <Param type="RichFloat" name="QualityThr" value="0.3"/>
  <Param type="RichBool" name="PreserveBoundary" value="false"/>
  <Param type="RichFloat" name="BoundaryWeight" value="1"/>
  <Param type="RichBool" name="PreserveNormal" value="false"/>
  <Param type="RichBool" name="PreserveTopology" value="false"/>
  <Param type="RichBool" name="OptimalPlacement" value="true"/>
  <Param type="RichBool" name="PlanarQuadric" value="false"/>
  <Param type="RichFloat" name="PlanarWeight" value="0.001"/>
  <Param type="RichBool" name="QualityWeight" value="false"/>
  <Param type="RichBool" name="AutoClean" value="true"/>
  <Param type="RichBool" name="Selected" value="false"/>
 </filter>
</FilterScript>
XML
# The edge length at which a surface of this area has about that many vertices: the remesh's own.
"$program" "$scan" "$work/ours.ply" -n "$nodes" --report "$work/ours.json" -q
edge=$(sed -n 's/^ *"mean": \([0-9.e+-]*\),*$/\1/p' "$work/ours.json" | sed -n 3p)
cat > "$work/isotropic.mlx" <<XML
<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Remeshing: Isotropic Explicit Remeshing">
  <Param type="RichInt" name="Iterations" value="10"/>
  <Param type="RichBool" name="Adaptive" value="false"/>
  <Param type="RichBool" name="SelectedOnly" value="false"/>
  <Param type="RichAbsPerc" name="TargetLen" value="$edge" min="0" max="10"/>
  <Param type="RichFloat" name="FeatureDeg" value="30"/>
  <Param type="RichBool" name="CheckSurfDist" value="false"/>
  <Param type="RichAbsPerc" name="MaxSurfDist" value="1" min="0" max="10"/>
  <Param type="RichBool" name="SplitFlag" value="true"/>
  <Param type="RichBool" name="CollapseFlag" value="true"/>
  <Param type="RichBool" name="SwapFlag" value="true"/>
  <Param type="RichBool" name="SmoothFlag" value="true"/>
  <Param type="RichBool" name="ReprojectFlag" value="true"/>
 </filter>
</FilterScript>
XML

vertices() { sed -n 's/^element vertex //p;/^end_header/q' "$1"; }

run() {  # name, output file, command...
  name=$1 out=$2
  shift 2
  i=0
  : > "$work/times"
  while [ $i -lt "$runs" ]; do
    rm -f "$out"
    /usr/bin/time -a -o "$work/times" -f '%e %M' "$@" > "$work/log" 2>&1 || true
    # meshlabserver's exit code says little; a run that wrote no mesh is no measurement.
    test -s "$out" || {
      echo "$name wrote no mesh:" >&2
      cat "$work/log" >&2
      exit 1
    }
    i=$((i + 1))
  done
  median=$(grep -E '^[0-9.]+ [0-9]+$' "$work/times" | sort -n | sed -n "$(((runs + 1) / 2))p")
  echo "$name $median $(vertices "$out")"
}

server="meshlabserver -i $scan"
{
  run wscvt "$work/ours.ply" "$program" "$scan" "$work/ours.ply" -n "$nodes" -q
  run wscvt-published "$work/published.ply" \
    "$program" "$scan" "$work/published.ply" -n "$nodes" -w area --method as-published -q
  # shellcheck disable=SC2086
  run meshlab-collapse "$work/collapse.ply" $server -o "$work/collapse.ply" -s "$work/collapse.mlx"
  # shellcheck disable=SC2086
  run meshlab-isotropic "$work/iso.ply" $server -o "$work/iso.ply" -s "$work/isotropic.mlx"
} | awk 'BEGIN { printf "%-18s %9s %11s %9s %14s\n", "tool", "seconds", "memory MB", "vertices", "time / wscvt" }
  NR == 1 { base = $2 }
  { printf "%-18s %9.2f %11.0f %9d %14.1f\n", $1, $2, $3 / 1024, $4, $2 / base }'
