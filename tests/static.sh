#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Uses the program without shared libraries: its files have the bytes of the program's, also in a root where nothing
# else is, and in bare roots of Debian 11 to 13.
#   tests/static.sh PROGRAM STATIC_PROGRAM MESHES WORK_FOLDER
# As root, for debootstrap and chroot. The roots stay in WORK_FOLDER and are used again.
set -eu
usage="usage: static.sh PROGRAM STATIC_PROGRAM MESHES WORK_FOLDER"
program=$(realpath "${1:?$usage}")
static=$(realpath "${2:?$usage}")
meshes=$(realpath "${3:?$usage}")
work=$(realpath -m "${4:?$usage}")
here=$(realpath "$(dirname "$0")")
mkdir -p "$work"
"$here/scripts/same_bytes_test.sh" "$program" "$static" "$meshes" "$work/same_bytes"

"$program" "$meshes/sand_7228.ply" "$work/program.ply" -q -n 300 --report "$work/report.json"
/usr/bin/python3 - "$here/texts" "$work/scan.tif" << 'END'
import sys
sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import run_readme
with open(sys.argv[2], "wb") as file:
    file.write(run_readme.tiff((20, 200, 200)))
END
use() {  # root
  mkdir -p "$1/opt/use"
  cp "$static" "$1/opt/use/wscvt"
  cp "$meshes/sand_7228.ply" "$work/scan.tif" "$1/opt/use"
  rm -f "$1"/opt/use/remesh.* "$1"/opt/use/labels.nrrd
  chroot "$1" /opt/use/wscvt /opt/use/sand_7228.ply /opt/use/remesh.ply -q -n 300 --report /opt/use/remesh.html
  chroot "$1" /opt/use/wscvt segment /opt/use/scan.tif /opt/use/labels.nrrd -q
  cmp "$work/program.ply" "$1/opt/use/remesh.ply"
  [ -s "$1/opt/use/labels.nrrd" ]
}
use "$work/empty"
echo "The program works in a root where nothing else is."
for suite in bullseye bookworm trixie; do
  [ -d "$work/$suite" ] || {
    rm -rf "$work/$suite.part"
    debootstrap --variant=minbase "$suite" "$work/$suite.part" http://deb.debian.org/debian > "$work/log" || {
      tail -n 20 "$work/log" >&2
      exit 1
    }
    mv -T "$work/$suite.part" "$work/$suite"
  }
  use "$work/$suite"
  echo "The program works in a bare root of $suite."
done
