#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the packages that the library, the plugin and their tests need on Debian 12, or the packages
# named as arguments. As root or with sudo, unless all are installed. May be killed and run again.
set -eu

packages="
  g++ cmake ninja-build clang-format clang-tidy dpkg-dev
  libopenmesh-dev libeigen3-dev libcgal-dev libboost-dev zlib1g-dev nlohmann-json3-dev
  libtiff-dev libexpat1-dev libpng-dev libstb-dev liblz4-dev libminizip-dev libnifti2-dev libhdf5-dev
  libinsighttoolkit5-dev libgmsh-dev
  pkg-config
  libcli11-dev libgtest-dev libbenchmark-dev gnuplot-nox time python3
  pybind11-dev python3-dev python3-numpy python3-pytest
  meshlab qtbase5-dev libqt5xmlpatterns5-dev libqt5opengl5-dev
  libglew-dev libglu1-mesa-dev
  xvfb xauth xdotool imagemagick fonts-dejavu-core"

[ $# -eq 0 ] || packages=$*

find_missing() {
  missing=
  for package in $packages; do
    state=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
    [ "$state" = "install ok installed" ] || missing="$missing $package"
  done
}
find_missing
[ -n "$missing" ] || exit 0
# One run at a time; another may have installed everything meanwhile.
exec 9< "$0"
flock 9
find_missing
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "These packages are missing, and neither root nor sudo is at hand:$missing" >&2
    exit 1
  }
  as_root=sudo
fi
# A run that was killed leaves packages unpacked that wait to be set up.
$as_root env DEBIAN_FRONTEND=noninteractive dpkg --configure -a
$as_root apt-get update
# shellcheck disable=SC2086
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
  -o DPkg::Lock::Timeout=600 --fix-broken $missing
