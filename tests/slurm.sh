#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Remeshes a sample of 1000 grains on a Slurm cluster on this machine, a controller and two nodes. One node is
# killed in the middle. Then does the same with GNU parallel. The tables must have the bytes of one batch's tables.
#   tests/slurm.sh PROGRAM WORK_FOLDER
# As root: each node has its own namespace of processes, so that all of it dies at once.
set -eu
program=$(realpath "${1:?usage: slurm.sh PROGRAM WORK_FOLDER}")
work=$(realpath -m "${2:?usage: slurm.sh PROGRAM WORK_FOLDER}")
scripts=$(realpath "$(dirname "$0")/../lib/program/cluster")
[ "$(id -u)" -eq 0 ] || {
  echo "The nodes of the cluster are namespaces, which needs root." >&2
  exit 1
}
fail() {
  echo "$1" >&2
  exit 1
}

rm -rf "$work"
mkdir -p "$work/scans" "$work/slurm/state"
cd "$work"
# Copies of 20 bodies, one of them broken. A grain's name decides its shard.
for k in $(seq 19); do
  "$program" create ellipsoid "body_$k.ply" --semi-axes 1 "0.$((60 + k))" 0.6 -n 400 -q
done
echo "no mesh" > body_20.ply
for k in $(seq 1000); do ln -s "../body_$((k % 20 + 1)).ply" "scans/grain_$k.ply"; done
options="-n 60 -d 6 --describe none"
# shellcheck disable=SC2086
"$program" batch "$work/scans" -o whole -q $options 2> whole.txt && fail "Nothing failed." || code=$?
[ "$code" -eq 3 ] || fail "One batch ended with $code."

host=$(hostname)
export SLURM_CONF="$work/slurm/slurm.conf" WSCVT="$program"
# A controller's credentials expire soon, so that what a dead node held is started again soon.
cat > "$SLURM_CONF" << CONF
ClusterName=wscvt_test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=17301
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
AuthInfo=cred_expire=5
CredType=cred/none
StateSaveLocation=$work/slurm/state
SlurmdSpoolDir=$work/slurm/spool-%n
SlurmctldPidFile=$work/slurm/controller.pid
SlurmdPidFile=$work/slurm/node-%n.pid
SlurmctldLogFile=$work/slurm/controller.log
SlurmdLogFile=$work/slurm/node-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdTimeout=5
MpiDefault=none
NodeName=one NodeHostname=$host NodeAddr=127.0.0.1 Port=17311 CPUs=2
NodeName=two NodeHostname=$host NodeAddr=127.0.0.1 Port=17312 CPUs=2
PartitionName=all Nodes=one,two Default=YES MaxTime=INFINITE State=UP
CONF
slurmctld -D -c > slurm/controller.txt 2>&1 &
pids=$!
stop() {
  # shellcheck disable=SC2086
  kill -9 $pids 2> /dev/null || true
}
trap stop EXIT
for node in one two; do
  unshare --pid --fork --kill-child --mount-proc slurmd -D -N "$node" > "slurm/$node.txt" 2>&1 &
  pids="$pids $!"
  eval "$node=$!"
done
for tries in $(seq 60); do
  [ "$(sinfo -h -N -t idle 2> /dev/null | wc -l)" -lt 2 ] || break
  [ "$tries" -lt 60 ] || fail "The cluster did not start: $(cat slurm/*.txt)"
  sleep 1
done

parts=6
# shellcheck disable=SC2086
job=$(sbatch --parsable --array=1-$parts --cpus-per-task=1 -o "$work/slurm/task-%a.txt" \
  "$scripts/wscvt-slurm" "$work/scans" -o "$work/out" $options)
# Until a task on the second node has rows to lose, and rows to come.
lines() { cat "$work/out/grains-$1-of-$parts.csv" 2> /dev/null | wc -l; }
killed=
for tries in $(seq 2000); do
  for task in $(squeue -h -t R -w two -j "$job" -o %K); do
    [ "$(lines "$task")" -lt 20 ] || killed=$task
  done
  [ -z "$killed" ] || break
  sleep 0.05
done
[ -n "$killed" ] || fail "No part was caught at work."
# shellcheck disable=SC2154
kill -9 "$two"
before=$(lines "$killed")
for tries in $(seq 300); do
  [ -n "$(squeue -h -j "$job" 2> /dev/null)" ] || break
  [ "$tries" -lt 300 ] || fail "The array does not end: $(squeue -j "$job")"
  sleep 1
done
scontrol show job "$job" -o | grep -q 'Restarts=[1-9]' || fail "No task was started again."
# shellcheck disable=SC2086
"$program" batch "$work/scans" -o out -q $options 2> joined.txt && fail "Nothing failed." || code=$?
[ "$code" -eq 3 ] || fail "The tables were not joined: $code."
cmp out/grains.csv whole/grains.csv
echo "Slurm: 1000 grains in $parts parts; a node died when part $killed had $((before - 1)) rows."

echo ":" > hosts
# shellcheck disable=SC2086
"$scripts/wscvt-parallel" hosts 3 "$work/by_parallel" "$work/scans" $options \
  > parallel.txt 2>&1 && fail "Nothing failed." || code=$?
[ "$code" -eq 3 ] || fail "parallel: $(tail -5 parallel.txt)"
cmp by_parallel/grains.csv whole/grains.csv
echo "GNU parallel: the same table."
