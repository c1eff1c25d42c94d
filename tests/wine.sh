#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the program for Windows under wine, and compares its files with those of the program here, byte by byte: both
# methods, all weightings, clumps, convex parts, volumes, reports; a batch that Ctrl-C stops and that goes on; names
# in other scripts, and paths beyond 260 characters.
#   tests/wine.sh PROGRAM WINDOWS_PROGRAM MESHES WORK_FOLDER
set -eu
usage="usage: wine.sh PROGRAM WINDOWS_PROGRAM MESHES WORK_FOLDER"
program=$(realpath "${1:?$usage}")
windows=$(realpath "${2:?$usage}")
meshes=$(realpath "${3:?$usage}")
work=$(realpath -m "${4:?$usage}")
here=$(realpath "$(dirname "$0")")
export WINEPREFIX="$work/prefix" WINEDEBUG=-all LC_ALL=C.UTF-8
rm -rf "$work/run"
mkdir -p "$work/run"
cd "$work/run"
fail() {
  echo "$1" >&2
  exit 1
}

# For the scripts that call a program. Wine has the root of this machine as a drive, so absolute names hold.
cat > wscvt << END
#!/bin/sh
exec wine "$windows" "\$@"
END
chmod +x wscvt
wine "$windows" --version | grep -q '^wscvt [0-9]' || fail "The program does not run under wine."
"$here/scripts/same_bytes_test.sh" "$program" ./wscvt "$meshes" same_bytes without-segment

# The dynamic libraries are those that every Windows has.
x86_64-w64-mingw32-objdump -p "$windows" | sed -n 's/^.*DLL Name: //p' | sort > libraries
! grep -vixE 'kernel32.dll|user32.dll|msvcrt.dll|advapi32.dll' libraries || fail "The program needs other libraries."

# Volumes of each format that this build has.
/usr/bin/python3 - "$here/texts" << 'END'
import gzip
import json
import os
import struct
import sys
import zlib

import numpy

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import run_readme
with open("scan.tif", "wb") as file:
    file.write(run_readme.tiff((20, 200, 200)))
z, y, x = numpy.mgrid[0:32, 0:32, 0:60]
labels = numpy.zeros((32, 32, 60), numpy.uint8)
for number, centre in ((1, 16), (2, 44)):
    labels[(x - centre) ** 2 + (y - 16) ** 2 + (z - 16) ** 2 < 13.3 ** 2] = number
numpy.save("labels.npy", labels)
numpy.savez_compressed("labels.npz", labels=labels)
labels.tofile("labels.raw")
with open("labels.json", "w", encoding="utf-8") as file:
    json.dump({"dimensions": [60, 32, 32], "type": "uint8"}, file)
head = b"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 60 32 32\nencoding: "
with open("labels.nrrd", "wb") as file:
    file.write(head + b"raw\n\n" + labels.tobytes())
with open("packed.nrrd", "wb") as file:
    file.write(head + b"gzip\n\n" + gzip.compress(labels.tobytes(), mtime=0))
with open("labels.vti", "w", encoding="utf-8") as file:
    file.write('<VTKFile type="ImageData"><ImageData WholeExtent="0 60 0 32 0 32" Origin="0 0 0" Spacing="1 1 1">'
               '<Piece Extent="0 60 0 32 0 32"><CellData Scalars="l"><DataArray type="UInt8" Name="l" format="ascii">'
               + " ".join(map(str, labels.ravel())) +
               "</DataArray></CellData></Piece></ImageData></VTKFile>\n")
# A header of NIfTI-1, then its voxels.
header = bytearray(352)
struct.pack_into("<i", header, 0, 348)
struct.pack_into("<8h", header, 40, 3, 60, 32, 32, 1, 1, 1, 1)
struct.pack_into("<hh", header, 70, 2, 8)
struct.pack_into("<8f", header, 76, 1, 1, 1, 1, 0, 0, 0, 0)
struct.pack_into("<f", header, 108, 352)
header[344:348] = b"n+1\0"
with open("labels.nii", "wb") as file:
    file.write(header + labels.tobytes())
os.mkdir("slices")
for slice_number in range(32):
    rows = b"".join(b"\0" + labels[slice_number, row].tobytes() for row in range(32))
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open(f"slices/s{slice_number}.png", "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 60, 32, 8, 0, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
END
for volume in labels.npy labels.npz labels.json labels.nrrd packed.nrrd labels.vti labels.nii slices; do
  "$program" extract $volume "here-$volume" -q --voxel-size 0.5mm
  ./wscvt extract $volume "there-$volume" -q --voxel-size 0.5mm
  diff -r "here-$volume" "there-$volume" || fail "The grains of $volume differ."
  [ -s "there-$volume/2.ply" ]
done
! ./wscvt segment scan.tif out.nrrd -q 2> said || fail "This build has no ITK, and did not say so."
grep -q "built without" said

# Names in other scripts, and a path that is longer than Windows had once.
odd="Körner 測定 😀"
long=$(printf '%0100d/%0100d/%0100d' 1 2 3)
for folder in "$odd" "$long"; do
  mkdir -p "$folder"
  cp "$meshes/sand_7228.ply" "$folder/größe.ply"
  gzip -kf "$folder/größe.ply"
  for grain in größe.ply größe.ply.gz; do
    ./wscvt "$folder/$grain" "$folder/netz.ply" -n 300 --report "$folder/bericht.html" --report "$folder/maße.json" \
      --node-table "$folder/knoten.csv" > out 2> said || fail "$(cat said)"
    "$program" "$folder/$grain" netz.ply -q -n 300
    cmp netz.ply "$folder/netz.ply"
    rm "$folder/netz.ply"
  done
  [ -s "$folder/maße.json" ]
  grep -q 'größe' "$folder/bericht.html"
  ! ./wscvt "$folder/fehlt.ply" x.ply -q 2> said || fail "A missing file was read."
  grep -qF "$folder/fehlt.ply" said || fail "The message has another name: $(cat said)"
done
! grep -q "$(printf '\r')" out || fail "Lines end as on Windows."

# A batch of a pattern, stopped by Ctrl-C at a console after its first grain, and continued.
mkdir scans
for k in 1 2 3 4 5; do
  for grain in "$meshes"/*.ply; do
    cp "$grain" "scans/$(basename "$grain" .ply)-$k.ply"
  done
done
"$program" batch 'scans/[a-s]*.ply' -o whole -q -n 300
x86_64-w64-mingw32-g++-posix -O2 -static "$here/wine/press_ctrl_c.cpp" -o press_ctrl_c.exe
code=0
script -qec "wine ./press_ctrl_c.exe parts/angular_6000-1.ply $windows batch 'scans/[a-s]*.ply' -o parts -n 300 --threads 1" \
  /dev/null > console || code=$?
[ $code -eq 130 ] || fail "Ctrl-C gave the exit code $code: $(cat console)"
[ -z "$(find parts -name '*.part*')" ] || fail "Ctrl-C left half a file."
done_before=$(find parts -name '*.ply' | wc -l)
[ "$done_before" -lt "$(find whole -name '*.ply' | wc -l)" ] || fail "Ctrl-C came too late to stop anything."
./wscvt batch 'scans/[a-s]*.ply' -o parts -q -n 300
for file in whole/*; do
  case $file in
    *.ply | *shape.csv) cmp "$file" "parts/$(basename "$file")" ;;
  esac
done
echo "The program for Windows works under wine; the batch was stopped after $done_before of its $(find whole -name '*.ply' | wc -l) grains."
