#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the source package for Debian of the last commit: program, library and Python module. A package of the plugin
# needs MeshLab's sources, which no package of Debian has.
#   DEBFULLNAME="Name" DEBEMAIL=address packages/make_debian_source.sh OUTPUT_FOLDER
set -eu
output=$(realpath -m "${1:?usage: make_debian_source.sh OUTPUT_FOLDER}")
cd "$(dirname "$0")/.."
version=$(sed -n 's/^project(wscvt VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
maintainer="${DEBFULLNAME:-The wscvt authors} <${DEBEMAIL:-wscvt@example.org}>"
folder=$output/wscvt-$version
rm -rf "$folder"
mkdir -p "$output"
git archive --prefix="wscvt-$version/" HEAD | xz > "$output/wscvt_$version.orig.tar.xz"
tar -xf "$output/wscvt_$version.orig.tar.xz" -C "$output"
cp -r "$folder/packages/debian" "$folder"
sed -i "s/@PROJECT_VERSION@/$version-1/; s/@WSCVT_MAINTAINER@/$maintainer/" "$folder/debian/control" "$folder/debian/changelog"
cd "$output"
dpkg-source -b "wscvt-$version"
