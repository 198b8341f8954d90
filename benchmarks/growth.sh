#!/bin/sh
# mrpt_fastlio: how time per scan and memory grow: with the length of a run, the points of a scan and their rate.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/growth.sh BUILD_DIR OUTPUT_DIR [ROW...]     (default: all rows; they need 20 minutes on one core)
# FACTOR in the environment shortens the long rows: 0.1 makes six minutes of an hour.
set -eu

if [ $# -lt 2 ]; then
  sed -n '4,7s/^# //p' "$0" >&2
  exit 2
fi
build=$1
output=$2
shift 2
factor=${FACTOR:-1}

scaled() { awk -v x="$1" -v f="$factor" 'BEGIN { printf "%.0f", x * f }'; }

# Options of fastlio-sim for a row.
options() {
  case $1 in
    hour_at_rest) echo "rest --lidar vlp16 --stride 4 --duration $(scaled 3600)" ;;
    hour_in_motion) echo "office --lidar vlp16 --stride 4 --duration $(scaled 3600)" ;;
    way_of_10_km | way_of_10_km_small_map)
      echo "town --lidar vlp16 --stride 4 --set world.length=$(scaled 10000)" ;;
    points_*) echo "office --lidar os64 --set lidar.columns=$((${1#points_} * 1000 / 64)) --duration 20" ;;
    rate_*) echo "office --lidar os64 --set lidar.columns=512 --scan-rate ${1#rate_} --duration 20" ;;
    *) echo "There is no row '$1'." >&2 && exit 2 ;;
  esac
}

# The largest memory that a process has used [kB]; it is asked until the process ends.
peak_memory() {
  peak=0
  while now=$(awk '/^VmHWM/ { print $2 }' "/proc/$1/status" 2>/dev/null) && [ -n "$now" ]; do
    peak=$now
    sleep 0.1
  done
  echo "$peak"
}

# Median and 99th percentile of the first and of the last fifth of the scans; the first ten have no map yet.
scan_times() {
  awk -F, '
    /^#/ { next }
    !column { for (i = 1; i <= NF; ++i) if ($i == "total_ms") column = i; next }
    ++scan > 10 { ms[++n] = $column; points += $3 }
    function part(first, last, q,    i, j, k, s, x) {
      k = 0
      for (i = first; i <= last; ++i) s[++k] = ms[i]
      for (i = 2; i <= k; ++i) { x = s[i]; for (j = i - 1; j > 0 && s[j] > x; --j) s[j + 1] = s[j]; s[j + 1] = x }
      return s[int(1 + q * (k - 1))]
    }
    END {
      fifth = int(n / 5); if (fifth > 500) fifth = 500
      printf "%d | %.1f | %.2f | %.2f | %.2f | %.2f", scan, points / n / 1000,
        part(1, fifth, 0.5), part(n - fifth + 1, n, 0.5), part(1, fifth, 0.99), part(n - fifth + 1, n, 0.99)
    }' "$1"
}

run_row() {
  mkdir -p "$output/$1"
  # shellcheck disable=SC2046
  "$build/bin/fastlio-sim" $(options "$1") --overwrite -o "$output/$1/recording" -q
  small=
  case $1 in *_small_map) small="--set map.radius=50" ;; esac
  # shellcheck disable=SC2086
  "$build/bin/fastlio-replay" "$output/$1/recording/recording.rawlog" -c "$output/$1/recording/config.yaml" \
    --set threads=1 $small --export timing,summary --overwrite -o "$output/$1/run" \
    >"$output/$1/replay.log" 2>&1 &
  memory=$(peak_memory $!)
  wait $! || echo "fastlio-replay ended with $? in row $1" >&2
  echo "| $1 | $(scan_times "$output/$1/run/timing.csv") | $((memory / 1024)) |"
  rm -rf "$output/$1/recording"
}

[ $# -gt 0 ] || set -- hour_at_rest hour_in_motion way_of_10_km way_of_10_km_small_map \
  points_10 points_50 points_100 points_200 rate_10 rate_20 rate_50 rate_100
echo "Milliseconds per scan on one core: median and 99th percentile of the first and the last fifth of the run (at most"
echo "500 scans each), and the largest memory of fastlio-replay, of which its libraries are about 70 MB."
echo
echo "| row | scans | thousand points per scan | median, first | median, last | p99, first | p99, last | memory [MB] |"
echo "|---|--:|--:|--:|--:|--:|--:|--:|"
for row in "$@"; do
  run_row "$row"
done
