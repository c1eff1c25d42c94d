#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints the grains per second of wscvt batch and of one process per file. Use an idle machine.
#   tests/figures/benchmarks/batch_rate.sh PROGRAM SCAN COUNT [OPTIONS of wscvt remesh]
set -eu
program=$(realpath "${1:?usage: batch_rate.sh PROGRAM SCAN COUNT [OPTIONS]}")
scan=$(realpath "$2")
count=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir scans
for k in $(seq "$count"); do ln -s "$scan" "scans/$k.${scan##*.}"; done
now() { date +%s.%N; }
rate() { awk -v from="$2" -v to="$3" -v n="$count" -v what="$1" \
  'BEGIN { printf "%s: %.1f grains a second\n", what, n / (to - from) }'; }

start=$(now)
for one in scans/*; do
  "$program" remesh "$one" one.ply -q --report table.csv "$@" 2> /dev/null
done
end=$(now)
rate "one process a file" "$start" "$end"
start=$(now)
"$program" batch scans -o plain -q --describe none "$@"
end=$(now)
rate "wscvt batch without descriptors" "$start" "$end"
start=$(now)
"$program" batch scans -o out -q "$@"
end=$(now)
rate "wscvt batch with all descriptors" "$start" "$end"
