#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Starts MeshLab with a mesh, opens the plugin's filter that remeshes, applies it by mouse
# and writes two pictures: the dialog and the result.
#   filter_wscvt/show_filter.sh MESHLAB MESH DIALOG_PNG RESULT_PNG
# Run it with xvfb-run. Needs xdotool and ImageMagick's import.
set -eu
filter="Remeshing: Weighted Spherical Centroidal Voronoi"
work=$(mktemp -d)
meshlab=
trap 'if [ -n "$meshlab" ]; then kill "$meshlab" 2>/dev/null || true; fi; rm -rf "$work"' EXIT
trap 'exit 143' HUP INT TERM

# Its own settings. Software rendering, because a virtual display has no other.
mkdir -p "$work/runtime"
chmod 700 "$work/runtime"
HOME=$work XDG_CONFIG_HOME=$work/config XDG_RUNTIME_DIR=$work/runtime LIBGL_ALWAYS_SOFTWARE=1 \
  LC_ALL=C.UTF-8 "$1" "$2" > "$work/log" 2>&1 &
meshlab=$!

wait_for() {  # what for, command that succeeds once it is there
  what=$1
  shift
  for _ in $(seq 120); do
    if "$@" > /dev/null 2>&1; then return; fi
    kill -0 "$meshlab" 2>/dev/null || break
    sleep 0.5
  done
  echo "MeshLab shows no $what. Its log:" >&2
  cat "$work/log" >&2
  exit 1
}
window() { xdotool search --onlyvisible --name "$1" | head -n 1; }

wait_for "mesh" grep -q "Opened mesh" "$work/log"
wait_for "window" xdotool search --onlyvisible --name '^MeshLab '
main=$(window '^MeshLab ')
xdotool windowmove "$main" 0 0 windowsize "$main" 1280 1000
sleep 1
xdotool windowfocus --sync "$main" key ctrl+f
sleep 1
xdotool type --delay 30 "${filter#*: }"
sleep 1
xdotool key Down
sleep 0.5
xdotool key Return
wait_for "dialog" xdotool search --onlyvisible --name "^$filter"
sleep 1
import -window root "$3"

# Apply is at the right of the dialog's lower edge, Close at the left.
eval "$(xdotool getwindowgeometry --shell "$(window "^$filter")")"
xdotool mousemove $((X + WIDTH * 3 / 4)) $((Y + HEIGHT - 22)) click 1
wait_for "result" grep -q "$filter in " "$work/log"
xdotool mousemove $((X + WIDTH / 4)) $((Y + HEIGHT - 22)) click 1
sleep 2
import -window root "$4"
sed -n 's/^LOG: [12] //p' "$work/log"
