#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs lib/examples/workflow/Snakefile on three small volumes, once in one piece and once interrupted while
# a batch is at work. Fails unless both give the same table, page by page the same bytes, and every grain has
# its remesh.
#   tests/workflow.sh PROGRAM FOLDER
# Leaves the results and graph.png, the steps of the workflow, in FOLDER. Needs snakemake, graphviz and NumPy.
set -eu
program=$(realpath "${1:?usage: workflow.sh PROGRAM FOLDER}")
folder=$(realpath -m "${2:?usage: workflow.sh PROGRAM FOLDER}")
examples=$(realpath "$(dirname "$0")/../lib/examples")
rm -rf "$folder"
mkdir -p "$folder/scans"
cd "$folder"
/usr/bin/python3 "$examples/ct_volume.py" whole.npy
# Three volumes of their own: turned, and one that cuts grains at its border. One name has a space, one begins
# as another, which is also that of the page of all.
/usr/bin/python3 - << 'END'
import numpy

volume = numpy.load("whole.npy")
numpy.save("scans/sample.1.npy", volume)
numpy.save("scans/south pit.npy", volume[::-1, :, ::-1].copy())
numpy.save("scans/sample.npy", volume[:60].transpose(1, 0, 2).copy())
END

flow() {  # folder to run in, further arguments
  mkdir -p "$1"
  (
    cd "$1"
    shift
    exec snakemake -s "$examples/workflow/Snakefile" --cores 2 "$@" \
      --config scans=../scans out=out nodes=400 "wscvt=$program" > log 2>&1
  )
}
flow whole
# A background job of a shell ignores Ctrl-C, so TERM, to Snakemake and the batch.
mkdir cut
setsid sh -c 'cd cut && exec snakemake -s "$0/workflow/Snakefile" --cores 2 --config scans=../scans out=out nodes=400 "wscvt=$1"' \
  "$examples" "$program" > cut/log.first 2>&1 &
running=$!
tries=0
until ls cut/out/grains/*/*.ply > /dev/null 2>&1; do
  tries=$((tries + 1))
  [ "$tries" -lt 1200 ] || { echo "The workflow made no remesh in two minutes." >&2; exit 1; }
  sleep 0.1
done
kill -TERM "-$running"
wait "$running" && { echo "The workflow was not interrupted." >&2; exit 1; }
[ ! -e cut/out/sample.html ] || { echo "The workflow ended before it was interrupted." >&2; exit 1; }
flow cut
cmp whole/out/shape.csv cut/out/shape.csv
cmp whole/out/sample.html cut/out/sample.html
for scan in sample sample.1 "south pit"; do
  cmp "whole/out/grains/$scan/grains.csv" "cut/out/grains/$scan/grains.csv"
done
rows=$(($(wc -l < whole/out/shape.csv) - 1))
meshes=$(find whole/out -name '*.ply' | wc -l)
[ "$rows" -ge 30 ] && [ "$rows" -eq "$meshes" ] || {
  echo "The table has $rows grains, the folders have $meshes remeshes." >&2
  exit 1
}
flow whole --forceall --dag
sed -n '/^digraph/,$p' whole/log | dot -Tpng -Gsize=9,9 -Gdpi=72 > graph.png
echo "$rows grains of three volumes, with and without an interruption, in $folder."
