#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Drives the window of another Debian's MeshLab with the plugin that was built here for its version: menu,
# search, dialogs, Apply, log. MeshLab runs in a root of that Debian with nothing else of this project. This
# machine sends keys and clicks, and takes the pictures.
#   tests/windows.sh BUILD SUITE [GTEST_FILTER]
# SUITE: trixie (MeshLab 2022.02) or sid (2025.07). BUILD was configured with the source of that version
# among MESHLAB_OTHER_SOURCE_DIRS. As root, for debootstrap and chroot. The root stays in
# build/meshlab-SUITE and is used again. The pictures are in BUILD/tests/host/VERSION/stage.
set -eu
usage="usage: windows.sh BUILD SUITE [GTEST_FILTER]"
build=$(realpath "${1:?$usage}")
suite=${2:?$usage}
root=$(realpath "$(dirname "$0")/..")
tree=$root/build/meshlab-$suite
case $suite in
  trixie) version=2022_02 ;;
  sid) version=2025_07 ;;
  *)
    echo "$usage" >&2
    exit 2 ;;
esac
[ "$(id -u)" -eq 0 ] || {
  echo "Making a root of Debian $suite needs root." >&2
  exit 1
}

# Under its name only when it is whole; without what a killed run left.
if [ ! -d "$tree" ]; then
  rm -rf "$tree.part"
  mkdir -p "$root/build"
  debootstrap --variant=minbase "$suite" "$tree.part" http://deb.debian.org/debian
  # The index of sid on a mirror that lags is out of date, but signed.
  echo 'Acquire::Check-Valid-Until "false";' > "$tree.part/etc/apt/apt.conf.d/90lagging-mirror"
  # shellcheck disable=SC2016
  unshare --mount sh -euc 'mount -t proc proc "$1/proc"
    chroot "$1" sh -euc "apt-get update
      DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
        meshlab libgl1-mesa-dri fonts-dejavu-core libmpfr6
      # MeshLab would ask about its plugins whose libraries are not there before it starts.
      cd /usr/lib/*-linux-gnu/meshlab
      for plugin in plugins/*.so; do
        ! LD_LIBRARY_PATH=. ldd \$plugin | grep -q \"not found\" || rm \$plugin
      done"' sh "$tree.part"
  mv -T "$tree.part" "$tree"
fi

cmake --build "$build" --target "window_tests_$version"
stage=$build/tests/host/$version/stage
cp "$stage/libfilter_wscvt.so" "$tree"/usr/lib/*-linux-gnu/meshlab/plugins
# The tests call this for MeshLab. Their folders and the meshes have the same names inside; the mounts go
# with the process.
mkdir -p "$stage/bin"
cat > "$stage/bin/meshlab" << END
#!/bin/sh
exec unshare --mount sh -euc '
  tree=\$1
  shift
  mount -t proc proc "\$tree/proc"
  mount --rbind /dev "\$tree/dev"
  mount --bind /tmp "\$tree/tmp"
  mkdir -p "\$tree$root/meshes" "\$tree$root/filter_wscvt"
  mount --bind "$root/meshes" "\$tree$root/meshes"
  mount --bind "$root/filter_wscvt" "\$tree$root/filter_wscvt"
  exec chroot "\$tree" /usr/bin/meshlab "\$@"' sh "$tree" "\$@"
END
chmod +x "$stage/bin/meshlab"
"$build/tests/host/window_tests_$version" --gtest_filter="${3:-*}"
echo "MeshLab of $suite works with the plugin; pictures of its window are in $stage."
