#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the Debian packages of a build, checks them with lintian, installs them, uses the installed program,
# library, module and plugin, and removes them: nothing may be left. Checks the description for software
# catalogues with appstreamcli. As root or with sudo.
#   tests/packages.sh BUILD_FOLDER WORK_FOLDER
set -eu
build=$(realpath "${1:?usage: packages.sh BUILD_FOLDER WORK_FOLDER}")
work=$(realpath -m "${2:?usage: packages.sh BUILD_FOLDER WORK_FOLDER}")
root=$(realpath "$(dirname "$0")/..")
as_root=
[ "$(id -u)" -eq 0 ] || as_root=sudo
fail() {
  echo "$1" >&2
  exit 1
}

rm -rf "$work"
mkdir -p "$work"
cd "$work"
# cpack looks for its configuration where it is called.
(cd "$build" && cpack -G DEB -B "$work/made" > "$work/cpack.txt") || fail "$(cat cpack.txt)"
names=
for package in made/*.deb; do
  name=$(dpkg-deb -f "$package" Package)
  ! dpkg-query -W -f '${Status}' "$name" 2> /dev/null | grep -q ' installed' ||
    fail "$name is installed already; remove it first: this test removes what it installs."
  names="$names $name"
done
for name in wscvt libwscvt-dev python3-wscvt wscvt-meshlab-plugin; do
  echo "$names" | grep -qw "$name" || fail "There is no package $name among$names."
done

appstreamcli validate --no-net "$root/packages/wscvt.metainfo.xml" > appstream.txt 2>&1 || fail "$(cat appstream.txt)"
lintian --allow-root --fail-on error,warning made/*.deb > lintian.txt 2>&1 || fail "$(cat lintian.txt)"

remove() {
  # shellcheck disable=SC2086
  $as_root env DEBIAN_FRONTEND=noninteractive dpkg --purge $names > removed.txt 2>&1 || true
}
trap remove EXIT
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
  -o DPkg::Lock::Timeout=600 ./made/*.deb > installed.txt 2>&1 || fail "$(tail -20 installed.txt)"
# shellcheck disable=SC2086
dpkg -L $names | sort -u > files.txt

# The program, from the path, with its texts.
cd /
[ "$(command -v wscvt)" = /usr/bin/wscvt ] || fail "wscvt is not what the package installed."
wscvt "$root/meshes/sand_7228.ply" "$work/remesh.ply" -q -n 200
grep -aq "element vertex 200" "$work/remesh.ply"
bash -c '. /usr/share/bash-completion/completions/wscvt && complete -p wscvt' > /dev/null
for command in $(wscvt --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
  [ -e "/usr/share/man/man1/wscvt-$command.1.gz" ] || fail "There is no manual page of $command."
done
for name in $names; do
  [ -e "/usr/share/doc/$name/copyright" ] && [ -e "/usr/share/doc/$name/changelog.gz" ] ||
    fail "The documents of $name are not there."
done
for file in wscvt/README.md python3-wscvt/README.md wscvt-meshlab-plugin/examples/wscvt_d.mlx; do
  [ -e "/usr/share/doc/$file" ] || fail "There is no /usr/share/doc/$file."
done
# The library, by a project that knows nothing of this folder.
cmake -S "$root/tests/consumer" -B "$work/consumer" -D "examples_dir=$root/lib/examples" > "$work/consumer.txt"
cmake --build "$work/consumer" >> "$work/consumer.txt"
grep -q "wscvt_DIR:PATH=/usr/lib" "$work/consumer/CMakeCache.txt" ||
  fail "The consumer was not built on the installed library."
(cd "$work" && /usr/bin/python3 -B -c '
import wscvt
assert wscvt.__file__.startswith("/usr/"), wscvt.__file__
assert len(wscvt.create("ellipsoid", nodes=100).faces) == 196')
# The plugin: all it needs is found, and its filters run where MeshLab has a program for that.
plugin=$(grep '/meshlab/plugins/libfilter_wscvt.so$' "$work/files.txt")
! LD_LIBRARY_PATH=$(dirname "$(dirname "$plugin")") ldd "$plugin" | grep 'not found'
if command -v meshlabserver > /dev/null; then
  xvfb-run -a meshlabserver -i "$root/meshes/sand_7228.ply" -s "$root/filter_wscvt/wscvt_d.mlx" \
    -o "$work/by_plugin.ply" > "$work/meshlabserver.txt" 2>&1 || true
  grep -aq "element vertex 1000" "$work/by_plugin.ply" || fail "$(cat "$work/meshlabserver.txt")"
fi

cd "$work"
remove
trap - EXIT
left=$(grep -E 'wscvt' files.txt | while read -r file; do [ ! -e "$file" ] || echo "$file"; done)
[ -z "$left" ] || fail "These are left after the packages were removed: $left"
echo "The packages install, work and go."
