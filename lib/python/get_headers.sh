#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Fetches packages of another Debian: the headers of its Python and of the pybind11 for it, its C library.
#   lib/python/get_headers.sh FOLDER SUITE PACKAGE...
#   lib/python/get_headers.sh build/headers-trixie trixie libpython3.13-dev pybind11-dev
# Unpacks the packages into FOLDER, for CMake's option WSCVT_PYTHON_OTHER_HEADERS. Does nothing if FOLDER
# is there. Needs no root. apt checks the packages against the archive's signed index.
set -eu
folder=$(realpath -m "${1:?usage: get_headers.sh FOLDER SUITE PACKAGE...}")
suite=${2:?usage: get_headers.sh FOLDER SUITE PACKAGE...}
shift 2
[ ! -d "$folder" ] || exit 0
keyring=/usr/share/keyrings/debian-archive-keyring.gpg
test -f "$keyring" || {
  echo "Debian's keys are missing. Run: apt-get install debian-archive-keyring" >&2
  exit 1
}

part=$folder.part
rm -rf "$part"
trap 'rm -rf "$part"' EXIT
mkdir -p "$part/lists/partial" "$part/archives/partial" "$part/debs" "$part/tree"
echo "deb [signed-by=$keyring] http://deb.debian.org/debian $suite main" > "$part/sources.list"
in_private() {
  apt-get -q -o Dir::Etc::SourceList="$part/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o Dir::State::Lists="$part/lists" -o Dir::State::Status=/dev/null -o Dir::Cache="$part" \
    -o APT::Sandbox::User="$(id -un)" "$@"
}
in_private update
(cd "$part/debs" && in_private download "$@")
for package in "$part"/debs/*.deb; do
  dpkg-deb -x "$package" "$part/tree"
done
mv -T "$part/tree" "$folder"
