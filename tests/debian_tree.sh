#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs demo.sh in a tree of another Debian, as a newcomer would, then the tests inside that Debian's real
# MeshLab: menu, dialog, Apply, log.
#   tests/debian_tree.sh SUITE
# SUITE: bookworm (Debian 12 with MeshLab 2020.09), trixie (Debian 13 with 2022.02), sid (2025.07).
# As root; needs debootstrap, which tests/run_all.sh installs. The tree stays in build/debian-SUITE
# and is used again. The pictures are in build/debian-SUITE-pictures.
set -eu
suite=${1:?usage: debian_tree.sh SUITE}
root=$(realpath "$(dirname "$0")/..")
tree=$root/build/debian-$suite
pictures=$tree-pictures
[ "$(id -u)" -eq 0 ] || {
  echo "Making a tree of Debian $suite needs root." >&2
  exit 1
}

# Under its name only when it is whole; without what a killed run left.
if [ ! -d "$tree" ]; then
  rm -rf "$tree.part"
  mkdir -p "$root/build"
  debootstrap --variant=minbase "$suite" "$tree.part" http://deb.debian.org/debian
  # The index of sid on a mirror that lags is out of date, but signed.
  if [ "$suite" = sid ]; then
    echo 'Acquire::Check-Valid-Until "false";' > "$tree.part/etc/apt/apt.conf.d/90lagging-mirror"
  fi
  mv -T "$tree.part" "$tree"
fi

# X servers and MeshLab want /proc and /dev; a mount namespace of its own goes with the process.
mkdir -p "$tree/project"
# Without files that are gone from the project; what was built stays.
find "$tree/project" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
(cd "$root" && git ls-files -z | tar -c --null -T -) | tar -x -C "$tree/project"
# shellcheck disable=SC2016
unshare --mount sh -eu -c '
  mount -t proc proc "$1/proc"
  mount --rbind /dev "$1/dev"
  chroot "$1" sh -eu -c "
    cd /project
    # Warnings are errors by the flags of the first build, so that there is no second one.
    CXXFLAGS=-Werror filter_wscvt/demo.sh
    nice cmake --build --preset release --target host_tests
    ctest --preset release -R ^host"
' sh "$tree"

mkdir -p "$pictures"
find "$tree/project/build" "$tree/project/build/release/tests/host" -maxdepth 1 -name '*.png' \
  -exec cp -t "$pictures" {} +
echo "Pictures of the window are in $pictures."
