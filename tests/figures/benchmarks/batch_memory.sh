#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints the peak memory of wscvt batch for each COUNT of grains: the scans of a folder in turn, under new
# names.
#   tests/figures/benchmarks/batch_memory.sh PROGRAM FOLDER COUNT... [-- OPTIONS of wscvt remesh]
set -eu
program=$(realpath "${1:?usage: batch_memory.sh PROGRAM FOLDER COUNT... [-- OPTIONS]}")
folder=$(realpath "${2:?usage: batch_memory.sh PROGRAM FOLDER COUNT... [-- OPTIONS]}")
shift 2
counts=
while [ $# -gt 0 ] && [ "$1" != -- ]; do
  counts="$counts $1"
  shift
done
[ $# -eq 0 ] || shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
for count in $counts; do
  rm -rf scans out
  mkdir scans
  made=0
  while [ "$made" -lt "$count" ]; do
    for scan in "$folder"/*.ply; do
      [ "$made" -lt "$count" ] || break
      made=$((made + 1))
      ln -s "$scan" "scans/$made.ply"
    done
  done
  python3 -c '
import resource, subprocess, sys
subprocess.run(sys.argv[2:], check=True)
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
print(f"{sys.argv[1]} grains: {peak / 1024:.1f} MiB")' \
    "$count" "$program" batch scans -o out -q --describe none "$@"
done
