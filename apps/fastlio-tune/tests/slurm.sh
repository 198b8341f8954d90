#!/bin/sh
# mrpt_fastlio: the job array of fastlio-tune --print-slurm on a Slurm of one machine, which this test starts: no run is
# lost, none is done twice. Exit status 77 (skipped) where Slurm is not installed (slurm-wlm).
# SPDX-License-Identifier: BSD-3-Clause
#
# slurm.sh FASTLIO_TUNE FASTLIO_SIM          JOBS=1000 in the environment: so many parameter sets
set -eu
tune=$1 sim=$2
for program in slurmctld slurmd munged sbatch; do
  command -v "$program" >/dev/null || PATH=$PATH:/usr/sbin
  command -v "$program" >/dev/null || { echo "skipped: $program is not installed (slurm-wlm)"; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo 'skipped: slurmd needs root'; exit 77; }

dir=$(mktemp -d)
daemons=
finish() {
  # shellcheck disable=SC2086  # a list of processes
  [ -z "$daemons" ] || kill $daemons 2>/dev/null || true
  wait || true
  rm -rf "$dir"
}
trap finish EXIT
cd "$dir"
chmod 755 .
fail() { echo "slurm.sh: $*"; tail -n 20 ./*.log; exit 1; }
wait_for() { # SECONDS COMMAND...
  left=$1
  shift
  until "$@" >/dev/null 2>&1; do
    left=$((left - 1))
    [ "$left" -gt 0 ] || fail "waited in vain: $*"
    sleep 1
  done
}

mkdir state spool run
head -c 1024 /dev/urandom >key
chmod 700 run
chmod 400 key
host=$(hostname -s)
cat >slurm.conf <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmctldPort=16817
SlurmdPort=16818
AuthType=auth/munge
AuthInfo=socket=$dir/run/munge
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/ctld.pid
SlurmdPidFile=$dir/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc)
PartitionName=test Nodes=$host Default=YES State=UP OverSubscribe=YES
END
export SLURM_CONF="$dir/slurm.conf"
munged --force --foreground --key-file="$dir/key" --socket="$dir/run/munge" --pid-file="$dir/run/munge.pid" \
  --log-file="$dir/munge.log" --seed-file="$dir/run/seed" --num-threads=2 >munged.log 2>&1 &
daemons="$daemons $!"
wait_for 20 test -S run/munge
slurmctld -D -f slurm.conf >ctld.log 2>&1 &
daemons="$daemons $!"
slurmd -D -f slurm.conf >slurmd.log 2>&1 &
daemons="$daemons $!"
wait_for 40 sh -c 'sinfo -h -o %T | grep -q idle'

for part in a:0 b:6; do
  "$sim" office -o sim -q --overwrite --duration 3 --rest 2 --set "path_start=${part#*:}" --set lidar.stride=8
  mv sim/recording.rawlog "${part%:*}.rawlog"
  mv sim/ground_truth.tum "${part%:*}.gt.tum"
done
printf 'initialization:\n  duration: 1.5\n' >base.yaml
printf 'measurement:\n  range_noise: {min: 0.01, max: 0.05}\nmap:\n  voxel_size: {min: 0.3, max: 0.6}\n' >space.yaml
search() {
  "$tune" space.yaml a.rawlog b.rawlog -c base.yaml --method random --budget "${JOBS:-20}" -o tuned.yaml "$@"
}
search -q --print-slurm 4 >array.sh
total=$("$tune" --status tuned.yaml.sqlite | awk 'NR == 2 {print $3}')
[ "$total" -ge "${JOBS:-20}" ] || fail "$total jobs"
sbatch array.sh || fail sbatch
wait_for 600 sh -c '[ -z "$(squeue -h)" ]'
"$tune" --status tuned.yaml.sqlite
[ "$("$tune" --status tuned.yaml.sqlite | awk 'NR == 2 {print $3, $4, $5, $6, $7}')" = "0 0 $total 0 $total" ] ||
  fail 'runs were lost, done twice, or failed'
status=0
search -j 0 -q >result.log || status=$?
[ "$status" -ne 1 ] || fail "status $status"
echo "slurm.sh: ok, $total runs"
