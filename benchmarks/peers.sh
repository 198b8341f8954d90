#!/bin/sh
# mrpt_fastlio: error and time per scan beside those of peers, from the same numbers, one after the other on one core.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/peers.sh BUILD_DIR PEERS_DIR RECORDING.rawlog...     (each with NAME.gt.tum beside it)
# BUILD_DIR is a build for the machine at hand (preset `release`, MRPT_FASTLIO_BENCHMARKS=ON). PEERS_DIR has clones of
# https://github.com/PRBonn/rko_lio, https://github.com/93won/lidar_inertial_odometry (Surfel-LIO) and
# https://github.com/strasdat/Sophus; they are built in PEERS_DIR/build with the packages libtbb-dev, robin-map-dev and
# libyaml-cpp-dev. RUNS in the environment: how often each program runs (5); CORE: on which core (0). The times are those
# of the odometry, without reading.
set -eu

if [ $# -lt 3 ]; then
  sed -n '5,11s/^# //p' "$0" >&2
  exit 2
fi
build=$1
peers=$(cd "$2" && pwd)
shift 2
here=$(cd "$(dirname "$0")" && pwd)
runs=${RUNS:-5}
core=${CORE:-0}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for source in rko_lio lidar_inertial_odometry Sophus; do
  [ -d "$peers/$source" ] || { echo "$peers has no clone of $source." >&2 && exit 2; }
done
build_peers() { cmake -S "$here/peers" -B "$peers/build" -G Ninja -DPEERS="$peers" && ninja -C "$peers/build"; }
build_peers >"$work/build.log" 2>&1 || { cat "$work/build.log" >&2 && exit 1; }

# The configuration of Surfel-LIO for a kind of sensor. Its configuration for 128 lines takes every 64th point, which is
# one line of a sensor with 64 lines: these take the one for 16 lines.
surfel_config() {
  case $1 in
    *livox*) echo "$peers/lidar_inertial_odometry/config/avia.yaml" ;;
    *) echo "$peers/lidar_inertial_odometry/config/ntu_viral.yaml" ;;
  esac
}

# Leaves $work/NAME.tum, and in $work/NAME.ms the least time of each scan over all runs, as fastlio-benchmark has it.
run_peer() {
  run=0
  : >"$work/all"
  while [ $((run += 1)) -le "$runs" ]; do
    taskset -c "$core" "$peers/build/peer-$1" "$work/input" "$work/$1" "$(surfel_config "$2")" >/dev/null 2>&1
    paste "$work/all" "$work/$1.ms" >"$work/more"
    mv "$work/more" "$work/all"
  done
  awk '{ least = $1; for (i = 2; i <= NF; ++i) if ($i < least) least = $i; print least }' "$work/all" >"$work/$1.ms"
}

# Median and 99th percentile [ms] of the scans; the first two make the map.
peer_times() {
  sed 1,2d "$work/$1.ms" | sort -g \
    | awk '{ x[NR] = $1 } END { printf "%.2f | %.2f\n", x[int(0.5 + NR / 2)], x[int(0.5 + 0.99 * NR)] }'
}

run_ours() {
  status=0
  taskset -c "$core" "$build/bin/fastlio-replay" "$1" --set threads=1 --frame imu --export trajectory -q --overwrite \
    -o "$work/run" >/dev/null 2>&1 || status=$?
  [ "$status" = 0 ] || echo "fastlio-replay ended with $status on $1" >&2
  mv "$work/run/trajectory.tum" "$work/mrpt_fastlio.tum"
}

our_times() {
  taskset -c "$core" "$build/benchmarks/macro/fastlio-benchmark" --recording "$1" --threads 1 --repeats "$runs" \
    | awk -F'|' '{ printf "%.2f | %.2f\n", $5, $6 }'
}

position_error() {
  "$build/bin/fastlio-eval" "$2" "$1" --json - 2>/dev/null | awk -f "$here/flatten_json.awk" \
    | awk '$1 == "ape.translation_m.rmse" { printf "%.4f", $2 }'
}

row() { echo "| $1 | $2 | $(position_error "$work/$2.tum" "${3%.rawlog}.gt.tum") | ${4:-lost | -} |"; }

echo "Processor: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1); one core, each scan in its fastest of $runs runs."
for source in rko_lio lidar_inertial_odometry; do
  echo "$source: $(git -C "$peers/$source" log -1 --format='%h of %cs' 2>/dev/null || echo 'no clone of git')."
done
echo
echo "| recording | program | error [m] | median [ms] | 99th percentile [ms] |"
echo "|---|---|--:|--:|--:|"
for recording in "$@"; do
  name=$(basename "$recording" .rawlog)
  "$build/benchmarks/macro/fastlio-peer-input" "$recording" "$work/input"
  row "$name" mrpt_fastlio "$recording" "$(run_ours "$recording" && our_times "$recording")"
  for program in rko_lio surfel_lio; do
    row "$name" "$program" "$recording" "$(run_peer "$program" "$recording" && peer_times "$program")"
  done
done
