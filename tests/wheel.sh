#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the wheel of the Python module and uses it in roots of Debian 11 to 14 that have only Python and
# NumPy. Each must make the bytes of the program's mesh. So must the modules of other Pythons
# that are on PATH, NumPy or not. As root, for debootstrap.
#   tests/wheel.sh BUILD WORK_FOLDER
# The roots stay in WORK_FOLDER and are used again.
set -eu
build=$(realpath "${1:?usage: wheel.sh BUILD WORK_FOLDER}")
work=$(realpath -m "${2:?usage: wheel.sh BUILD WORK_FOLDER}")
root=$(realpath "$(dirname "$0")/..")
fail() {
  echo "$1" >&2
  exit 1
}
[ "$(id -u)" -eq 0 ] || fail "Making a root of Debian needs root."

mkdir -p "$work"
rm -f "$work"/*.whl
"$root/lib/python/make_wheel.py" "$build" "$work"
wheel=$(echo "$work"/wscvt-*.whl)
[ -f "$wheel" ] || fail "There is not one wheel in $work."
"$build/lib/wscvt" "$root/meshes/sand_7228.ply" "$work/program.ply" -q -n 300

for suite in bullseye bookworm trixie forky; do
  tree=$work/$suite
  if [ ! -d "$tree" ]; then
    rm -rf "$tree.part"
    debootstrap --variant=minbase --include=python3,python3-numpy "$suite" "$tree.part" \
      http://deb.debian.org/debian /usr/share/debootstrap/scripts/sid > "$work/debootstrap-$suite.txt" ||
      fail "$(tail -n 20 "$work/debootstrap-$suite.txt")"
    mv -T "$tree.part" "$tree"
  fi
  python=$(chroot "$tree" python3 -c 'import sys; print("%d.%d" % sys.version_info[:2])')
  # The root has no pip; that of this system chooses and unpacks the wheel as the one there would.
  rm -rf "$tree/opt/wscvt"
  /usr/bin/python3 -m pip install -q --no-index --no-deps --only-binary=:all: --root-user-action=ignore \
    --python-version "$python" --platform manylinux_2_31_x86_64 --target "$tree/opt/wscvt" "$wheel"
  cp "$root/meshes/sand_7228.ply" "$root/lib/examples/one_grain.py" "$tree/opt"
  chroot "$tree" env PYTHONPATH=/opt/wscvt PYTHONDONTWRITEBYTECODE=1 python3 -c '
import wscvt
wscvt.write_mesh("/opt/remesh.ply", wscvt.remesh("/opt/sand_7228.ply", 300))
import numpy
z, y, x = numpy.mgrid[0:32, 0:32, 0:60]
balls = [200 * ((x - centre) ** 2 + (y - 16) ** 2 + (z - 16) ** 2 < 150) for centre in (16, 40)]
found = wscvt.segment(numpy.maximum(*balls).astype(numpy.uint8), 1.0)
assert found["grains"] == 2, found'
  cmp "$work/program.ply" "$tree/opt/remesh.ply" ||
    fail "The wheel in $suite made another mesh than the program."
  chroot "$tree" env PYTHONPATH=/opt/wscvt python3 /opt/one_grain.py /opt/sand_7228.ply /opt/one.ply \
    > "$work/one_grain-$suite.txt"
  # Its own libraries are loaded, not those that the root happens to have.
  for library in gmp mpfr; do
    chroot "$tree" sh -c 'ldd /opt/wscvt/wscvt/_wscvt.*.so' |
      grep -q "lib$library\.so.* => /opt/wscvt/wscvt/libs/" ||
      fail "The module in $suite does not load the lib$library of the wheel."
  done
  echo "The wheel works in a bare root of $suite, with Python $python."
done

rm -rf "$work/whole"
/usr/bin/python3 -m zipfile -e "$wheel" "$work/whole"
for module in "$work"/whole/wscvt/_wscvt.*.so; do
  python=python3.$(echo "$module" | sed 's/.*cpython-3\([0-9]*\).*/\1/')
  "$python" -c '' 2> "$work/python.txt" || continue
  rm -rf "$work/batch"
  PYTHONPATH=$work/whole/wscvt "$python" -Bc '
import sys, _wscvt
_wscvt._batch([sys.argv[1]], sys.argv[2], nodes=300)' "$root/meshes/sand_7228.ply" "$work/batch"
  cmp "$work/program.ply" "$work/batch/sand_7228.ply" || fail "The module for $python made another mesh than the program."
  echo "The module for $python works."
done

# The commands of the texts word for word, as in a clone where build/release is built.
rm -rf "$work/clone"
mkdir -p "$work/clone/build"
ln -s "$root/lib" "$root/filter_wscvt" "$root/meshes" "$work/clone"
ln -s "$build" "$work/clone/build/release"
cd "$work/clone"
for text in lib/python filter_wscvt/host_blender; do
  sed -n 's/^    \([a-z].*\)/\1/p' "$root/$text/README.md" > commands.txt
  [ -s commands.txt ] || fail "$text/README.md has no commands."
  while read -r command; do
    env -u PYTHONPATH PATH=/usr/bin:/bin sh -euc "$command" > said.txt 2>&1 < /dev/null ||
      fail "$text/README.md: $command: $(cat said.txt)"
  done < commands.txt
done
[ -f build/blender/wscvt-*-blender.zip ] || fail "The add-on's zip is not where its text says."
echo "The commands of lib/python/README.md and filter_wscvt/host_blender/README.md work."
