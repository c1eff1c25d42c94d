#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the source package for Debian of the last commit, builds its packages, checks all of them with lintian, and runs the
# package's own tests (autopkgtest) in a bare root of Debian 12. As root, for debootstrap.
#   tests/debian_source.sh WORK_FOLDER
# The root stays in WORK_FOLDER, and each run uses a copy of it. The build takes half an hour of processor time.
set -eu
work=$(realpath -m "${1:?usage: debian_source.sh WORK_FOLDER}")
root=$(realpath "$(dirname "$0")/..")
fail() {
  echo "$1" >&2
  exit 1
}
tree=$work/bookworm
mkdir -p "$work"
if [ ! -d "$tree" ]; then
  rm -rf "$tree.part"
  debootstrap --variant=minbase --include=dpkg-dev bookworm "$tree.part" http://deb.debian.org/debian \
    > "$work/debootstrap.txt" || fail "$(tail -n 20 "$work/debootstrap.txt")"
  mv -T "$tree.part" "$tree"
fi
rm -rf "$work/made" "$work/root"
"$root/packages/make_debian_source.sh" "$work/made"
cd "$work"/made/wscvt-*/
dpkg-buildpackage -us -uc > "$work/build.txt" 2>&1 || fail "$(tail -n 20 "$work/build.txt")"
cd "$work/made"
# Whoever uploads it first writes the number of Debian's request (ITP) into the changelog.
lintian --allow-root --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs wscvt_*.changes
cp -a "$tree" "$work/root"
autopkgtest wscvt_*.changes -- chroot "$work/root" > "$work/tests.txt" 2>&1 || fail "$(tail -n 20 "$work/tests.txt")"
sed -n '/ summary$/,$p' "$work/tests.txt"
