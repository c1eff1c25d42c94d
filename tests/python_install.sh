#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the Python module with pip from an archive of its sources (sdist), without the network, into an environment
# of its own, runs its tests there, with PROGRAM, and removes it: nothing may be left.
#   tests/python_install.sh PROGRAM WORK_FOLDER
set -eu
program=$(realpath "${1:?usage: python_install.sh PROGRAM WORK_FOLDER}")
work=$(realpath -m "${2:?usage: python_install.sh PROGRAM WORK_FOLDER}")
root=$(realpath "$(dirname "$0")/..")
fail() {
  echo "$1" >&2
  exit 1
}

rm -rf "$work"
mkdir -p "$work/source"
trap 'rm -rf "$work"' EXIT
# pip builds beside setup.py.
cp -r "$root/CMakeLists.txt" "$root/LICENSE" "$root/lib" "$work/source"
# What is missing is named. The environment's folder of programs has no CMake.
/usr/bin/python3 -m venv --system-site-packages "$work/environment"
! env PATH="$work/environment/bin" "$work/environment/bin/python" -m pip install --no-index \
  --no-build-isolation "$work/source/lib/python" > "$work/missing.txt" 2>&1 ||
  fail "pip installed the module without CMake."
grep -q 'cmake is missing' "$work/missing.txt" && grep -q 'apt-get install g++ cmake' "$work/missing.txt" ||
  fail "pip does not name what is missing: $(tail -n 20 "$work/missing.txt")"
# NumPy, pytest and what pip builds with are Debian's. The archive of the sources, for an index, has all that pip needs.
python=$work/environment/bin/python
(cd "$work/source/lib/python" && "$python" setup.py -q sdist -d "$work") > "$work/archive.txt" 2>&1 ||
  fail "$(tail -n 20 "$work/archive.txt")"
"$python" -m pip install --no-index --no-build-isolation "$work"/wscvt-*.tar.gz \
  > "$work/installed.txt" 2>&1 || fail "$(tail -n 40 "$work/installed.txt")"

cd "$work"
unset PYTHONPATH
export PYTHONDONTWRITEBYTECODE=1 WSCVT_PROGRAM="$program" WSCVT_MESHES_DIR="$root/meshes"
export WSCVT_README="$root/lib/python/README.md"
found=$("$python" -c 'import wscvt; print(wscvt.__file__)')
case $found in
  "$work"/environment/*/wscvt/__init__.py) ;;
  *) fail "The module is not what pip installed but $found." ;;
esac
"$python" -m pytest -q -p no:cacheprovider "$root/tests/python"
"$python" -m pip uninstall -q -y wscvt
left=$(find "$work/environment" -name '*wscvt*')
[ -z "$left" ] || fail "These are left after pip has removed the module: $left"
echo "pip installs the module, it works, and it goes."
