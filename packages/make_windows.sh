#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the archive for Windows, on Debian: wscvt.exe, which needs no other file, its README and the licences.
#   packages/make_windows.sh OUTPUT.zip
# Needs g++-mingw-w64-x86-64-posix and libz-mingw-w64-dev beside the packages of this project. The program is
# build/windows/lib/wscvt.exe.
set -eu
output=$(realpath -m "${1:?usage: make_windows.sh OUTPUT.zip}")
here=$(realpath "$(dirname "$0")")
cd "$here/.."
"$here/windows/libraries.sh"
cmake --preset windows > build/windows.txt || {
  cat build/windows.txt >&2
  exit 1
}
cmake --build --preset windows -j "${JOBS:-$(nproc)}"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/wscvt/licences"
cp build/windows/lib/wscvt.exe LICENSE CHANGELOG.md meshes/sand_7228.ply "$folder/wscvt"
x86_64-w64-mingw32-strip "$folder/wscvt/wscvt.exe"
# Lines as Windows' editors want them.
sed 's/$/\r/' "$here/windows/README.txt" > "$folder/wscvt/README.txt"
for package in libeigen3-dev libcgal-dev libboost-dev libopenmesh-dev nlohmann-json3-dev libcli11-dev libstb-dev \
  liblz4-dev libminizip-dev libniftiio-dev libpng-dev libtiff-dev libexpat1-dev libz-mingw-w64-dev \
  mingw-w64-common gcc-mingw-w64-base; do
  for text in "/usr/share/doc/$package/copyright" "/usr/share/doc/$package/copyright.gz"; do
    [ ! -e "$text" ] || cp "$text" "$folder/wscvt/licences/$package.txt"
  done
done
rm -f "$output"
(cd "$folder" && cmake -E tar cf "$output" --format=zip --mtime=2022-07-01 wscvt)
echo "$output: $(stat -c %s "$output") bytes."
