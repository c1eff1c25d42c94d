#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the files of a release and uses them as their users would: the archive in bare roots of Debian 11, 12
# and 13, its plugins with the MeshLab of their version, and the steps of the Containerfile, which install
# the Debian package in a bare root. The wheel, the add-on and the other packages have tests of their own.
# As root, for debootstrap.
#   tests/release_files.sh BUILD RELEASE WORK_FOLDER
# The roots stay in WORK_FOLDER and are used again.
set -eu
usage="usage: release_files.sh BUILD RELEASE WORK_FOLDER"
build=$(realpath "${1:?$usage}")
release=$(realpath -m "${2:?$usage}")
work=$(realpath -m "${3:?$usage}")
root=$(realpath "$(dirname "$0")/..")
fail() {
  echo "$1" >&2
  exit 1
}
[ "$(id -u)" -eq 0 ] || fail "Making a root of Debian needs root."

"$root/packages/make_release.py" "$build" "$release"
(cd "$release" && sha256sum --quiet -c SHA256SUMS)
mkdir -p "$work"
"$build/lib/wscvt" "$root/meshes/sand_7228.ply" "$work/program.ply" -q -n 300
/usr/bin/python3 - "$work/mask.nrrd" <<'END'
import sys
ball = lambda x, y, z: (x - 12) ** 2 + (y - 9) ** 2 + (z - 10) ** 2 < 60
voxels = " ".join(str(int(ball(x, y, z))) for z in range(20) for y in range(20) for x in range(24))
open(sys.argv[1], "w").write("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 24 20 20\n"
                             "encoding: ascii\n\n" + voxels + "\n")
END

bare_root() {  # suite
  [ -d "$work/$1" ] && return
  rm -rf "$work/$1.part"
  debootstrap --variant=minbase "$1" "$work/$1.part" http://deb.debian.org/debian \
    > "$work/debootstrap-$1.txt" || fail "$(tail -n 20 "$work/debootstrap-$1.txt")"
  mv -T "$work/$1.part" "$work/$1"
}

# With /proc, by which a program finds the libraries beside it; the mount goes with the process.
in_root() {  # root, commands
  # shellcheck disable=SC2016
  unshare --mount sh -euc 'mount -t proc proc "$1/proc" && chroot "$1" sh -euc "$2"' sh "$1" "$2"
}

for suite in bullseye bookworm trixie; do
  bare_root "$suite"
  place=$work/$suite/opt
  rm -rf "$place"
  mkdir "$place"
  tar -xf "$release"/wscvt-*-linux-x86_64.tar.xz -C "$place"
  mv "$place"/wscvt-* "$place/wscvt"
  cp "$work/mask.nrrd" "$place"
  # The line of its README, word for word, then a volume.
  line=$(sed -n 's/^    \(bin\/wscvt .*\)/\1/p' "$place/wscvt/README.txt")
  in_root "$work/$suite" "cd /opt/wscvt
    $line > /opt/log.txt
    bin/wscvt meshes/sand_7228.ply /opt/remesh.ply -q -n 300
    bin/wscvt segment /opt/mask.nrrd /opt/labels.nrrd -q
    bin/wscvt batch /opt/labels.nrrd -o /opt/out -q -n 100"
  grep -aq "element vertex 1000" "$place/wscvt/remeshed.ply"
  grep -q "<svg\|data:image" "$place/wscvt/remesh.html" || fail "The page has no picture."
  cmp "$work/program.ply" "$place/remesh.ply" || fail "The program in $suite made another mesh."
  [ -s "$place/out/grains.csv" ] || fail "No grain came from the volume in $suite."
  echo "The archive works in a bare root of $suite."
done

# The plugins: 2020.09 in the MeshLab here, the others by the names that the MeshLab of theirs has.
archive=$work/bookworm/opt/wscvt
stage=$work/stage
rm -rf "$stage"
cp -a "$build/filter_wscvt/stage" "$stage"
plugins=$(echo "$stage"/lib/*/meshlab/plugins)
rm "$plugins/libfilter_wscvt.so"
cp -r "$archive"/meshlab/2020.09/* "$plugins"
xvfb-run -a "$stage/bin/meshlabserver" -i "$root/meshes/sand_7228.ply" -s "$archive/meshlab/wscvt_d.mlx" \
  -o "$work/by_plugin.ply" > "$work/meshlabserver.txt" 2>&1 || true
grep -aq "element vertex 1000" "$work/by_plugin.ply" || fail "$(tail -n 20 "$work/meshlabserver.txt")"
echo "The plugin works in MeshLab 2020.09."
names() { nm -D "$@" | sed 's/.* //; s/@.*//' | sort -u; }
for version in 2022.02:trixie 2025.07:sid; do
  suite=${version#*:}
  version=${version%:*}
  plugin=$archive/meshlab/$version/libfilter_wscvt.so
  [ -f "$plugin" ] || continue
  "$root/lib/python/get_headers.sh" "$work/meshlab-$suite" "$suite" meshlab
  real=$(find "$work/meshlab-$suite" -name libmeshlab-common.so)
  built=$build/tests/host/$(echo "$version" | tr . _)
  [ ! -d "${built}_float" ] || built=${built}_float
  built=$built/libmeshlab-common.so
  names --undefined-only "$plugin" > "$work/wanted.txt"
  names --defined-only "$built" | comm -12 - "$work/wanted.txt" > "$work/of_meshlab.txt"
  missing=$(names --defined-only "$real" | comm -13 - "$work/of_meshlab.txt")
  [ -s "$work/of_meshlab.txt" ] || fail "The plugin for $version wants nothing of MeshLab."
  [ -z "$missing" ] || fail "MeshLab of $suite lacks what the plugin for $version wants: $missing"
  echo "MeshLab of $suite has the $(wc -l < "$work/of_meshlab.txt") names that the plugin for $version wants."
done

# The Containerfile, whose steps are run in a root, for want of a registry here.
bare_root bookworm
container=$work/container
rm -rf "$container"
cp -a "$work/bookworm" "$container"
rm -rf "$container/opt"
cp "$release"/wscvt_*.deb "$container/tmp"
steps=$(sed -n '/^RUN /,/[^\\]$/p' "$release/Containerfile" | sed 's/^RUN //')
in_root "$container" "$steps" > "$work/container.txt" 2>&1 || fail "$(tail -n 20 "$work/container.txt")"
mkdir "$container/data"
cp "$root/meshes/sand_7228.ply" "$container/data/scan.ply"
in_root "$container" 'cd /data && wscvt scan.ply remesh.ply -q -n 300 --report remesh.html
  test -s /usr/share/doc/wscvt/copyright'
cmp "$work/program.ply" "$container/data/remesh.ply" || fail "The container's program made another mesh."
rm -rf "$container"
echo "The steps of the Containerfile install the package in a bare root, and it works."
