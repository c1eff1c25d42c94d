#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Fetches the source of the installed MeshLab, because no Debian package has its headers, or of the
# MeshLab of another Debian suite.
#   filter_wscvt/get_meshlab_source.sh FOLDER [SUITE]      (SUITE: bookworm, trixie, sid, ...)
# Creates FOLDER for CMake's option MESHLAB_SOURCE_DIR. Does nothing if FOLDER is there.
# Needs no root: the source entry and apt's lists are in a folder of this script. It fetches only the
# tarball of the source package: Debian's patches do not change the headers of src/common, and not all
# mirrors serve the rest. apt checks its hash against the archive's signed index.
# May be killed at any point and run again, or twice at once: FOLDER appears whole, by one rename.
set -eu

folder=$(realpath -m "${1:?usage: get_meshlab_source.sh FOLDER [SUITE]}")
suite=${2:-}
is_whole() { [ -f "$folder/ML_VERSION" ] && [ -d "$folder/src/common" ] &&
  { [ -d "$folder/vcglib" ] || [ -d "$folder/src/vcglib" ]; }; }  # beside src until 2020.09

# One run at a time; the lock goes with the processes that hold it, however they end.
mkdir -p "$(dirname "$folder")"
exec 9< "$(dirname "$folder")"
flock 9
# Beside FOLDER, so that the last step is a rename, and of one name, so that what a killed run left
# is found.
scratch=$folder.part
rm -rf "$scratch"
if is_whole; then exit 0; fi
if [ -e "$folder" ] && ! rmdir "$folder" 2>/dev/null; then
  echo "$folder exists but is not the whole source of MeshLab. Remove it or name another folder." >&2
  exit 1
fi

package=meshlab
uri=http://deb.debian.org/debian
if [ -z "$suite" ]; then
  version=$(dpkg-query -W -f '${Version}' meshlab 2>/dev/null) || {
    echo "MeshLab is not installed. Run: apt-get install meshlab" >&2
    exit 1
  }
  # "meshlab | version | URI suite/component architecture Packages" -> URI
  uri=$(apt-cache madison meshlab | awk -F '|' -v version="$version" \
    '{ gsub(/ /, "", $2) } $2 == version && $3 ~ /Packages/ { split($3, at, " "); print at[1]; exit }')
  if [ -z "$uri" ]; then
    echo "apt does not know the source of meshlab $version. Run: apt-get update" >&2
    exit 1
  fi
  uri=${uri%/}
  # A package built anew (+b1) has the source of the version before.
  package=meshlab=$(dpkg-query -W -f '${source:Version}' meshlab)
fi

trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/lists/partial" "$scratch/archives/partial" "$scratch/parts"
# As root apt downloads as the user _apt, where that user can come.
sandbox=root
if [ "$(id -u)" -eq 0 ] && chmod 755 "$scratch" && chown _apt "$scratch" 2>/dev/null &&
  runuser -u _apt -- test -w "$scratch" 2>/dev/null; then
  sandbox=_apt
fi

if [ -n "$suite" ]; then
  keyring=/usr/share/keyrings/debian-archive-keyring.gpg
  test -f "$keyring" || {
    echo "Debian's keys are missing. Run: apt-get install debian-archive-keyring" >&2
    exit 1
  }
  echo "deb-src [signed-by=$keyring] $uri $suite main" > "$scratch/parts/source.list"
fi
# The machine's own entries for that archive, with their keys and options, asked for sources.
[ -n "$suite" ] || for list in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
  case $list in
    *.list)
      if [ -f "$list" ]; then
        grep -F "$uri" "$list" | sed -n 's/^[[:space:]]*deb[[:space:]]/deb-src /p' \
          >> "$scratch/parts/source.list" || true
      fi ;;
    *.sources)
      if [ -f "$list" ]; then
        awk -v uri="$uri" 'BEGIN { RS = ""; ORS = "\n\n" } index($0, uri)' "$list" |
          sed -E 's/^Types:.*/Types: deb-src/' >> "$scratch/parts/source.sources"
      fi ;;
  esac
done

in_private() {
  # shellcheck disable=SC2086
  "$@" -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$scratch/parts" \
    -o Dir::State::Lists="$scratch/lists" -o Dir::Cache="$scratch" -o APT::Sandbox::User="$sandbox" \
    $lagging
}
# The index of sid on a mirror that lags is out of date, but signed. Of the machine's own suite its
# own settings say whether that is allowed.
lagging=
[ "$suite" != sid ] || lagging="-o Acquire::Check-Valid-Until=false"
in_private apt-get update
(cd "$scratch" && in_private apt-get source --download-only --tar-only "$package")
mkdir "$scratch/unpacked"
tar -xf "$scratch"/*.orig.tar.* -C "$scratch/unpacked" --no-same-owner
unpacked=$(find "$scratch/unpacked" -mindepth 2 -maxdepth 2 -name ML_VERSION -printf '%h\n')
mv -T "$unpacked" "$folder"
echo "The source of MeshLab $(cat "$folder/ML_VERSION") is in $folder."
