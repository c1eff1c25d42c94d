#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the Blender add-on, installs it into Blender, and runs its tests there: without a window, and
# in a window on a virtual screen, with a picture.
#   tests/blender.sh BUILD WORK_FOLDER [WHEEL]
# Makes the wheel from BUILD if WHEEL is not given.
set -eu
build=$(realpath "${1:?usage: blender.sh BUILD WORK_FOLDER [WHEEL]}")
work=$(realpath -m "${2:?usage: blender.sh BUILD WORK_FOLDER [WHEEL]}")
root=$(realpath "$(dirname "$0")/..")
rm -rf "$work"
mkdir -p "$work"
wheel=${3:-}
if [ -z "$wheel" ]; then
  "$root/lib/python/make_wheel.py" "$build" "$work"
  wheel=$(echo "$work"/wscvt-*.whl)
fi
"$root/filter_wscvt/host_blender/make_addon.py" "$wheel" "$work"
zip=$(echo "$work"/wscvt-*-blender.zip)

# A user's folder of its own, so that the machine's Blender stays as it is.
export BLENDER_USER_RESOURCES="$work/user" PYTHONDONTWRITEBYTECODE=1
blender --background --factory-startup --python-exit-code 1 \
  --python "$root/tests/blender/in_background.py" -- "$zip" "$root/meshes" > "$work/background.txt" 2>&1 ||
  { tail -n 30 "$work/background.txt" >&2; exit 1; }
tail -n 3 "$work/background.txt" | grep 'tests passed'
export LIBGL_ALWAYS_SOFTWARE=1
xvfb-run -a -s '-screen 0 1200x720x24' blender --factory-startup --window-geometry 0 0 1200 720 \
  --python "$root/tests/blender/in_window.py" -- "$zip" "$root/meshes/angular_6000.ply" \
  "$work/window.png" > "$work/window.txt" 2>&1 || { tail -n 30 "$work/window.txt" >&2; exit 1; }
grep "window's test passed" "$work/window.txt"
echo "The picture of the panel is $work/window.png."
