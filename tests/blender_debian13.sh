#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the add-on's tests without a window in the Blender of Debian 13, in a root of its own. As root.
#   tests/blender_debian13.sh ZIP WORK_FOLDER
# filter_wscvt/host_blender/make_addon.py makes ZIP. The root stays in WORK_FOLDER, 1.5 GB, and is used
# again.
set -eu
zip=$(realpath "${1:?usage: blender_debian13.sh ZIP WORK_FOLDER}")
work=$(realpath -m "${2:?usage: blender_debian13.sh ZIP WORK_FOLDER}")
root=$(realpath "$(dirname "$0")/..")
tree=$work/blender-trixie
mkdir -p "$work"
if [ ! -d "$tree" ]; then
  rm -rf "$tree.part"
  debootstrap --variant=minbase --include=python3-numpy trixie "$tree.part" http://deb.debian.org/debian
  chroot "$tree.part" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends blender
  mv -T "$tree.part" "$tree"
fi
rm -rf "$tree/opt/wscvt"
mkdir -p "$tree/opt/wscvt"
cp -r "$root/meshes" "$root/tests/blender" "$tree/opt/wscvt"
cp "$zip" "$tree/opt/wscvt/addon.zip"
# Blender wants /proc and /dev; a mount namespace of its own goes with the process.
# shellcheck disable=SC2016
unshare --mount sh -euc '
  mount -t proc proc "$1/proc"
  mount --rbind /dev "$1/dev"
  chroot "$1" env BLENDER_USER_RESOURCES=/opt/wscvt/user PYTHONDONTWRITEBYTECODE=1 \
    blender --background --factory-startup --python-exit-code 1 \
    --python /opt/wscvt/blender/in_background.py -- /opt/wscvt/addon.zip /opt/wscvt/meshes
' sh "$tree" > "$work/debian13.txt" 2>&1 || { tail -n 30 "$work/debian13.txt" >&2; exit 1; }
grep 'tests passed' "$work/debian13.txt"
