#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Kills filter_wscvt/get_meshlab_source.sh before and after each command that it runs, and runs it again.
# The whole source must then be there, and nothing else. Scripts replace apt and dpkg, so that neither
# root nor the network is needed.
#   killed_installers_test.sh SOURCE_FOLDER WORK_FOLDER
set -eu
root=$(realpath "$1")
script=$root/filter_wscvt/get_meshlab_source.sh
packages_script=$root/tests/install_packages.sh
rm -rf "$2"
mkdir -p "$2/bin" "$2/package/meshlab-1/src/common" "$2/package/meshlab-1/vcglib"
work=$(realpath "$2")

fail() {
  echo "$*" >&2
  exit 1
}

echo 2020.09 > "$work/package/meshlab-1/ML_VERSION"
for number in $(seq 40); do echo "$number" > "$work/package/meshlab-1/src/common/$number.h"; done
tar -C "$work/package" -cJf "$work/meshlab.orig.tar.xz" meshlab-1

# A command of the script: counts, and ends the script's processes when its turn has come.
wrap() {  # name, what it does
  cat > "$work/bin/$1" <<WRAPPED
#!/bin/sh
turn=\$((\$(cat "$work/turn") + 1))
echo \$turn > "$work/turn"
[ \$turn -ne "\${KILL_BEFORE:-0}" ] || kill -KILL 0
$2 || exit
[ \$turn -ne "\${KILL_AFTER:-0}" ] || kill -KILL 0
WRAPPED
  chmod +x "$work/bin/$1"
}
for command in mkdir rm rmdir mv tar find chmod realpath; do
  wrap "$command" "$(command -v "$command") \"\$@\""
done
wrap dpkg-query 'echo 1'
wrap apt-cache 'echo "meshlab | 1 | http://archive suite/main amd64 Packages"'
wrap apt-get "case \" \$* \" in *' source '*) cp $work/meshlab.orig.tar.xz . ;; esac"

run() { (cd "$work" && PATH="$work/bin:$PATH" setsid -w sh "$script" "$work/out/meshlab") >/dev/null 2>&1; }

expect_whole() {
  diff -r "$work/package/meshlab-1" "$work/out/meshlab" > /dev/null || fail "$1: not whole"
  [ "$(ls -A "$work/out")" = meshlab ] || fail "$1: $(ls -A "$work/out") is left"
}

echo 0 > "$work/turn"
run || fail "the script fails when nothing ends it"
turns=$(cat "$work/turn")
[ "$turns" -gt 8 ] || fail "only $turns commands were seen"
expect_whole "the first run"
for turn in $(seq "$turns"); do
  for when in KILL_BEFORE KILL_AFTER; do
    rm -rf "$work/out"
    echo 0 > "$work/turn"
    if (export "$when=$turn"; run); then fail "$when $turn did not end the script"; fi
    run || fail "the run after $when $turn failed"
    expect_whole "$when $turn"
    run || fail "a second run after $when $turn failed"
  done
done

# TERM, too, leaves nothing behind.
wrap apt-get 'kill -TERM $PPID'
rm -rf "$work/out"
run && fail "TERM did not end the script"
[ -z "$(ls -A "$work/out")" ] || fail "TERM: $(ls -A "$work/out") is left"

# Two at once, and a folder that is somebody's.
wrap apt-get "case \" \$* \" in *' source '*) cp $work/meshlab.orig.tar.xz . ;; esac"
run &
first=$!
run || fail "the second of two runs failed"
wait "$first" || fail "the first of two runs failed"
expect_whole "two at once"
rm "$work/out/meshlab/ML_VERSION"
run && fail "a folder that is not the source was taken for it"
[ -f "$work/out/meshlab/src/common/1.h" ] || fail "somebody's folder was touched"

# Packages: one left unpacked by a killed run is set up before others are installed.
echo > "$work/calls"
for command in dpkg apt-get; do
  printf '#!/bin/sh\necho "%s $*" >> "%s/calls"\n' "$command" "$work" > "$work/bin/$command"
done
printf '#!/bin/sh\nwhile [ $# -gt 1 ]; do shift; done\n"$@"\n' > "$work/bin/sudo"
printf '#!/bin/sh\n[ "$4" != cmake ] && echo install ok installed || echo install ok unpacked\n' \
  > "$work/bin/dpkg-query"
printf '#!/bin/sh\necho 0\n' > "$work/bin/id"
chmod +x "$work"/bin/*
PATH="$work/bin:$PATH" sh "$packages_script" || fail "the packages' script failed"
sed -n 2p "$work/calls" | grep -q 'dpkg --configure -a' || fail "nothing was set up"
grep -q 'apt-get install .* cmake$' "$work/calls" || fail "cmake was not installed"

rm -rf "$work"
echo "The installers survive."
