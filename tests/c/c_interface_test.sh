#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The interface for C gives the program's bytes, from C and from Python without a module of ours, and shows nothing but
# its own functions.
#   c_interface_test.sh PROGRAM C_INTERFACE_TEST LIBRARY SCAN WORK_FOLDER
set -eu
program=$1
test=$2
library=$3
scan=$4
work=$5
here=$(realpath "$(dirname "$0")")
rm -rf "$work"
mkdir -p "$work"
cd "$work"
"$program" "$scan" program.ply -q -n 300 --edge-ratio 1.3 -w wscvt-c
"$test" "$scan" c.ply
cmp program.ply c.ply
/usr/bin/python3 "$here/../../lib/examples/one_grain_ctypes.py" "$library" "$scan" python.ply
"$program" "$scan" program.ply -q -n 500
cmp program.ply python.ply
nm -D --defined-only "$library" | sed 's/.* //' | grep -v '^wscvt_' > others || true
[ ! -s others ] || {
  echo "The library shows more than its functions: $(head -n 5 others)" >&2
  exit 1
}
