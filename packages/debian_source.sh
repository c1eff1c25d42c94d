#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Fetches and unpacks the source of a Debian package, as its authors published it, unless FOLDER is there.
#   packages/debian_source.sh PACKAGE FOLDER
# Needs no root: apt's entries are asked for sources too, with lists of its own. FOLDER appears whole, by a rename.
set -eu
usage="usage: debian_source.sh PACKAGE FOLDER"
package=${1:?$usage}
folder=$(realpath -m "${2:?$usage}")
[ ! -d "$folder" ] || exit 0
scratch=$folder.part
rm -rf "$scratch"
mkdir -p "$scratch/lists/partial" "$scratch/archives/partial" "$scratch/parts" "$scratch/unpacked"
trap 'rm -rf "$scratch"' EXIT
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
  grep -qs debian.org "$list" || continue
  case $list in
    *.list) sed -n 's/^[[:space:]]*deb[[:space:]]/deb-src /p' "$list" ;;
    *.sources) sed 's/^Types:.*/Types: deb-src/' "$list" ;;
  esac > "$scratch/parts/$(basename "$list")"
done
private() {
  "$@" -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$scratch/parts" \
    -o Dir::State::Lists="$scratch/lists" -o Dir::Cache="$scratch" -o APT::Sandbox::User=root >> "$scratch/log" 2>&1 || {
    cat "$scratch/log" >&2
    exit 1
  }
}
cd "$scratch"
private apt-get update
private apt-get source --download-only --tar-only "$package"
tar -xf ./*.orig.tar.* -C unpacked --no-same-owner --strip-components=1
mv -T unpacked "$folder"
