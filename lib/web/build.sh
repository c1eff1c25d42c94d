#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the page that remeshes in the browser: a folder for any web server, without anything to install.
#   lib/web/build.sh FOLDER
# Needs Debian's emscripten, and its sources of OpenMesh and zlib, which are fetched once to build/web.
set -eu
folder=$(realpath -m "${1:?usage: build.sh FOLDER}")
here=$(realpath "$(dirname "$0")")
root=$(realpath "$here/../..")
work=$root/build/web
command -v emcc > /dev/null || {
  echo "emscripten is missing. Run: apt-get install emscripten" >&2
  exit 1
}

for package in openmesh zlib; do
  "$root/packages/debian_source.sh" $package "$work/sources/$package"
done

# Only these headers: the others of /usr/include are of another machine.
mkdir -p "$work/headers"
for name in eigen3 boost CGAL nlohmann; do
  ln -sfn "/usr/include/$name" "$work/headers/$name"
done
[ ! -d /usr/include/stb ] || ln -sfn /usr/include/stb "$work/headers/stb"

# The linker's optimiser finds its JavaScript packages there.
export NODE_PATH=/usr/share/nodejs
emcmake cmake -S "$here" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=None -DWSCVT_SOURCES="$work/sources" \
  -DWSCVT_HEADERS="$work/headers" > "$work/configure.txt"
cmake --build "$work/build"

rm -rf "$folder.part"
mkdir -p "$folder.part"
cp "$here/index.html" "$here/page.css" "$here/page.js" "$here/worker.js" \
  "$here/../wscvt/report/view.js" "$here/../wscvt/report/turning_view.js" "$folder.part"
cp "$work/build/wscvt.js" "$work/build/wscvt.wasm" "$folder.part"
gzip -9n < "$root/meshes/sand_7228.ply" > "$folder.part/sand_7228.ply.gz"
cp "$root/LICENSE" "$folder.part"
rm -rf "$folder"
mv -T "$folder.part" "$folder"
# What a visitor loads, as servers send it.
bytes=$(cd "$folder" && for file in *; do case $file in *.gz | LICENSE) ;; *) gzip -9 < "$file" ;; esac; done | wc -c)
echo "The page is in $folder: $bytes bytes packed, and the sample grain."
