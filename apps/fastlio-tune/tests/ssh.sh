#!/bin/sh
# mrpt_fastlio: the list of fastlio-tune --print-parallel, shared out by GNU parallel over ssh to two hosts, which are this
# machine under two names: no run is lost, none is done twice. Exit status 77 (skipped) without openssh-server or parallel.
# SPDX-License-Identifier: BSD-3-Clause
#
# ssh.sh FASTLIO_TUNE FASTLIO_SIM
set -eu
tune=$1 sim=$2
sshd=$(command -v sshd || echo /usr/sbin/sshd)
[ -x "$sshd" ] || { echo 'skipped: sshd is not installed (openssh-server)'; exit 77; }
command -v ssh >/dev/null || { echo 'skipped: ssh is not installed (openssh-client)'; exit 77; }
parallel --version 2>/dev/null | grep -q GNU || { echo 'skipped: GNU parallel is not installed'; exit 77; }

dir=$(mktemp -d)
daemon=
finish() {
  [ -z "$daemon" ] || kill "$daemon" 2>/dev/null || true
  wait || true
  rm -rf "$dir"
}
trap finish EXIT
cd "$dir"
fail() { echo "ssh.sh: $*"; tail -n 20 ./*.log; exit 1; }

# A server of its own: its keys, its port, nothing of the user's.
ssh-keygen -q -t ed25519 -N '' -f host_key
ssh-keygen -q -t ed25519 -N '' -f key
cp key.pub authorized
mkdir -p /run/sshd 2>/dev/null || true
port=$((20000 + $$ % 10000))
cat >sshd_config <<END
Port $port
ListenAddress 127.0.0.1
HostKey $dir/host_key
AuthorizedKeysFile $dir/authorized
PidFile $dir/sshd.pid
StrictModes no
UsePAM no
PermitRootLogin prohibit-password
PasswordAuthentication no
ForceCommand echo >>$dir/sessions; eval "\$SSH_ORIGINAL_COMMAND"
END
cat >ssh_config <<END
Host one two
  HostName 127.0.0.1
  Port $port
  User $(id -un)
  IdentityFile $dir/key
  IdentitiesOnly yes
  UserKnownHostsFile $dir/known
  StrictHostKeyChecking no
END
"$sshd" -f sshd_config -D -E sshd.log &
daemon=$!
tries=50
until ssh -F ssh_config one true 2>ssh.log; do
  kill -0 "$daemon" 2>/dev/null || { echo 'skipped: sshd does not run here'; cat sshd.log; exit 77; }
  tries=$((tries - 1))
  [ "$tries" -gt 0 ] || fail 'no connection'
  sleep 0.2
done

for part in a:0 b:6; do
  "$sim" office -o sim -q --duration 3 --rest 2 --seed 3 --set "path_start=${part#*:}" --set lidar.stride=6
  mv sim/recording.rawlog "${part%:*}.rawlog"
  mv sim/ground_truth.tum "${part%:*}.gt.tum"
done
printf 'measurement:\n  range_noise: [0.01, 0.02, 0.05]\nmap:\n  voxel_size: [0.3, 0.4, 0.5]\n' >space.yaml
search() { "$tune" space.yaml a.rawlog b.rawlog --method grid --budget 9 -o shared.yaml "$@"; }
search --print-parallel 4 >commands 2>print.log
parallel -j 2 --ssh "ssh -F $dir/ssh_config" --sshlogin one,two <commands >parallel.log 2>&1 || fail 'GNU parallel over ssh'
# Open, running, finished, failed, started: the base and nine sets on two recordings, each once.
counts=$("$tune" --status shared.yaml.sqlite | awk 'NR == 2 {print $3, $4, $5, $6, $7}')
[ "$counts" = '0 0 20 0 20' ] || fail "jobs: $counts"
# One to see whether it runs, and one for each worker.
[ "$(wc -l <sessions)" -ge 5 ] || fail 'the jobs did not go through ssh'
search -j 0 >result.log 2>&1 || [ $? -eq 2 ] || fail 'no result'
grep -q 'Effect of each key' result.log || fail 'no table'
echo 'ssh.sh: ok'
