#!/bin/sh
# mrpt_fastlio: fastlio-tune on short simulated recordings: a bad parameter file becomes a better one, a killed
# search goes on where it was, workers share a store.
# SPDX-License-Identifier: BSD-3-Clause
#
# tuning_runs.sh FASTLIO_TUNE FASTLIO_SIM FASTLIO_REPLAY FASTLIO_EVAL
set -eu
tune=$1 sim=$2 replay=$3 eval=$4
dir=$(mktemp -d)
trap '[ -n "${KEEP:-}" ] || rm -rf "$dir"' EXIT
cd "$dir"
mkdir tmp
export TMPDIR="$dir/tmp"
fail() { echo "tuning_runs.sh: $*"; cat log; exit 1; }
expect() { # STATUS TEXT COMMAND...
  status=$1 text=$2
  shift 2
  seen=0
  "$@" >log 2>&1 || seen=$?
  [ "$seen" -eq "$status" ] || fail "status $seen instead of $status: $*"
  grep -q -- "$text" log || fail "no '$text': $*"
}
counts() { # open running finished failed started of the only search
  "$tune" --status "$1" | awk 'NR == 2 {print $3, $4, $5, $6, $7}'
}

for part in a:0 b:6 c:12; do
  "$sim" office -o "sim_${part%:*}" -q --duration 4 --rest 2 --seed 3 --set "path_start=${part#*:}" --set lidar.stride=6 --time-offset 0.02
  mv "sim_${part%:*}/recording.rawlog" "${part%:*}.rawlog"
  mv "sim_${part%:*}/ground_truth.tum" "${part%:*}.gt.tum"
done
cat >bad.yaml <<'END'
initialization:
  duration: 1.5
lidar:
  time_offset: 0.04
calibration:
  estimate_time_offset: false
END
cat >space.yaml <<'END'
lidar:
  time_offset: {min: -0.05, max: 0.05}
measurement:
  range_noise: [0.01, 0.02, 0.05]
END

# A bad file becomes a better one, which fastlio-replay reads, and which is better by fastlio-eval's account.
expect 0 'Better parameters: tuned.yaml' "$tune" space.yaml a.rawlog b.rawlog c.rawlog -c bad.yaml -j 2 --budget 12 \
  --method cmaes -o tuned.yaml --json tuned.json
grep -q '^#.*time_offset: 0.04 -> ' tuned.yaml || fail 'tuned.yaml does not contain the change'
grep -q '"conclusion": "better"' tuned.json || fail 'tuned.json has another conclusion'
grep -q '<h1>Better parameters: tuned.yaml</h1>' tuned.html || fail 'tuned.html has another headline'
[ "$(grep -c '<tr><td>[abc].rawlog</td>' tuned.html)" -eq 3 ] || fail 'tuned.html lacks a recording'
[ "$(grep -c '<svg ' tuned.html)" -eq 3 ] || fail 'tuned.html: a figure per key, and the search'
[ "$(grep -c '<circle' tuned.html)" -ge 10 ] || fail 'tuned.html lacks sets'
grep -q '>lidar.time_offset \[s\]<' tuned.html || fail 'tuned.html: an axis has no unit'
! grep -q 'log10' tuned.html || fail 'tuned.html: an axis shows logarithms instead of values'
! grep -qE 'NaN|nan|inf' tuned.html || fail 'tuned.html has no numbers'
error() { # CONFIG: RMSE [m] on a.rawlog
  "$replay" a.rawlog -c "$1" -o run --overwrite -q --export trajectory 2>log || [ $? -eq 6 ]
  "$eval" a.gt.tum run/trajectory.tum --json - | grep -A9 '"ape"' | sed -n 's/.*"rmse": *\([0-9.e-]*\).*/\1/p' | head -1
}
before=$(error bad.yaml)
after=$(error tuned.yaml)
awk "BEGIN {exit !($after < 0.5 * $before)}" || fail "APE $before m before, $after m after"

# The same again runs nothing, and says the same.
cp tuned.yaml first.yaml
cp tuned.html first.html
before=$(counts tuned.yaml.sqlite)
expect 0 'Better parameters' "$tune" space.yaml a.rawlog b.rawlog c.rawlog -c bad.yaml --budget 12 -o tuned.yaml
cmp tuned.yaml first.yaml || fail 'the second time gives other parameters'
cmp tuned.html first.html || fail 'the second time gives another page'
[ "$(counts tuned.yaml.sqlite)" = "$before" ] || fail 'finished runs were run again'

# Killed twice at any time, then continued: no run lost, none stored twice, and the same result.
for pause in 0.2 1; do
  "$tune" space.yaml a.rawlog b.rawlog c.rawlog -c bad.yaml -j 2 --budget 12 -o killed.yaml >log 2>&1 &
  process=$!
  sleep "$pause"
  kill -9 "$process" 2>/dev/null || true
  wait "$process" || true
  # The runs end with it, however it ends.
  sleep 0.3
  ! pgrep -f "$TMPDIR" >/dev/null || fail 'a run goes on after its tuner was killed'
done
expect 0 'Better parameters' "$tune" space.yaml a.rawlog b.rawlog c.rawlog -c bad.yaml -j 2 --budget 12 -o killed.yaml \
  --report other.html
[ -s other.html ] && [ ! -e killed.html ] || fail '--report names the page'
[ -z "$(ls tmp)" ] || fail "left in TMPDIR: $(ls tmp)"
cmp killed.yaml first.yaml || fail 'a killed search ends with other parameters'
echo "$(counts tuned.yaml.sqlite) $(counts killed.yaml.sqlite)" | awk '
  {exit !($6 == 0 && $7 == 0 && $8 == $3 && $9 == 0 && $10 >= $8 && $10 <= $8 + 4)}' ||
  fail "jobs without kill: $(counts tuned.yaml.sqlite), with: $(counts killed.yaml.sqlite)"

# Killed before there was anything in the folder of a run. A folder of others is not ours to remove.
"$tune" space.yaml a.rawlog b.rawlog -c bad.yaml -j 2 --budget 200 --method random -o early.yaml >log 2>&1 &
process=$!
while kill -STOP "$process" && [ -z "$(ls tmp)" ]; do
  kill -CONT "$process"
  sleep 0.01
done
kill -9 "$process"
wait "$process" || true
sleep 0.3
rm -rf tmp/*/*
mkdir tmp/fastlio-tune-AbCdEf tmp/fastlio-tune-1-2-3-AbCdEf
expect 0 'Better parameters' "$tune" space.yaml a.rawlog b.rawlog -c bad.yaml --method grid --budget 9 -o after.yaml
rmdir tmp/fastlio-tune-AbCdEf tmp/fastlio-tune-1-2-3-AbCdEf || fail 'a folder of others was removed'
[ -z "$(ls tmp)" ] || fail "left in TMPDIR by a killed tuner: $(ls tmp)"

# Ctrl-C gives running jobs back and ends the runs.
"$tune" space.yaml a.rawlog b.rawlog c.rawlog -c bad.yaml -j 2 --budget 200 --method random -o stopped.yaml >log 2>&1 &
process=$!
sleep 0.7
kill -TERM "$process"
status=0
wait "$process" || status=$?
[ "$status" -eq 130 ] || fail "status $status after SIGTERM"
[ "$(counts stopped.yaml.sqlite | cut -d' ' -f2)" -eq 0 ] || fail 'jobs are still claimed after SIGTERM'

# Workers do the jobs of a printed list; the tuner then only prints the result.
search() {
  "$tune" space.yaml a.rawlog b.rawlog -c bad.yaml --method grid --budget 9 -o shared.yaml --store shared.sqlite "$@"
}
search --print-parallel 3 >commands 2>log
[ "$(counts shared.sqlite)" = "20 0 0 0 0" ] || fail "jobs of the grid: $(counts shared.sqlite)"
# moreutils has another program of that name.
if parallel --version 2>/dev/null | grep -q GNU; then
  parallel -j 3 <commands >log 2>&1 || fail 'GNU parallel'
else
  echo 'tuning_runs.sh: GNU parallel is not installed; sh runs its list instead'
  while read -r command; do
    sh -c "$command" >log 2>&1 || fail "$command"
  done <commands
fi
[ "$(counts shared.sqlite)" = "0 0 20 0 20" ] || fail "jobs after the workers: $(counts shared.sqlite)"
expect 0 'Better parameters' search -j 0
search --print-slurm 4 2>log | sh -n
search --print-slurm 4 2>log | grep -q '^#SBATCH --array=1-4$' || fail 'no job array'
# Slurm would end a name at its first blank.
"$tune" space.yaml a.rawlog b.rawlog --method grid --budget 9 --store 'two words.sqlite' --print-slurm 4 2>log |
  grep -q "^#SBATCH --output='.*/two words.sqlite.%A_%a.log'\$" || fail 'the log of the job array'

# What fails is said, ranks last, and is run again only when asked for.
printf 'lidar:\n  min_range: [1, 200]\n' >fails.yaml
expect 2 'Failed: .*max_range' "$tune" fails.yaml a.rawlog b.rawlog --method grid -o f.yaml
[ "$(counts f.yaml.sqlite | cut -d' ' -f4-)" = "2 8" ] || fail "failures: $(counts f.yaml.sqlite)"
expect 2 'Keep' "$tune" fails.yaml a.rawlog b.rawlog --method grid -o f.yaml --retry-failed
[ "$(counts f.yaml.sqlite | cut -d' ' -f4-)" = "2 10" ] || fail "failures: $(counts f.yaml.sqlite)"

# Good parameters are kept; one recording cannot show anything.
[ ! -e f.yaml ] || fail 'parameters that are no better were written'
expect 2 'one recording' "$tune" fails.yaml a.rawlog --method grid -o f.yaml

# No output replaces an input, and no other database becomes a store.
expect 1 'a.rawlog' "$tune" space.yaml a.rawlog -o a.rawlog
expect 1 'same file' "$tune" space.yaml a.rawlog -o o.yaml --store o.yaml
expect 1 "job store 'bad.yaml'" "$tune" space.yaml a.rawlog -o o.yaml --store bad.yaml
expect 1 'ground truth' "$tune" space.yaml a.rawlog sim_a/scenario.json
expect 1 '2 recordings' "$tune" space.yaml a.rawlog b.rawlog --truth a.gt.tum
mkdir moved
cp a.rawlog b.rawlog moved
expect 1 'ground truth' "$tune" fails.yaml moved/a.rawlog --measure ape
expect 2 'Error: ape' "$tune" fails.yaml moved/a.rawlog moved/b.rawlog --truth a.gt.tum --truth b.gt.tum --method grid \
  -o f.yaml
expect 2 'Error: proxy' "$tune" fails.yaml moved/a.rawlog moved/b.rawlog --method grid -o f.yaml
expect 0 'mean' "$tune" space.yaml a.rawlog b.rawlog --rank --budget 6 -o rank.yaml
echo "tuning_runs.sh: ok"
