#!/bin/sh
# mrpt_fastlio: digests of what fastlio-replay writes, to compare two states of the code byte by byte.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: tests/digests/digests.sh BUILD_DIR WORK_DIR [RECORDINGS_DIR] >digests.txt
# Simulates scenarios, replays them and, if given, the recordings NAME.rawlog of RECORDINGS_DIR.
# Run it for both states on one machine and compare the two lists with diff. Lists of different
# machines may differ: the C library's mathematical functions are not the same to the last bit on
# every processor.
set -eu

if [ $# -lt 2 ]; then
  sed -n '4,8s/^# //p' "$0" >&2
  exit 2
fi
build=$1
work=$2
recordings=${3:-}
duration=${DURATION:-20}
scenarios=${SCENARIOS:-office campus uav car shake spin stairs crowd}

program() { echo "$build/apps/$1/$1"; }

# The paper's alternatives that are off by default: every one has its own path through the code.
variant_keys() {
  case $1 in
    knn) echo 'map: {type: knn}' ;;
    features) echo 'features: {mode: planar_and_edge}' ;;
    motion) echo 'initialization: {mode: motion}' ;;
    extrinsic) echo 'calibration: {estimate_extrinsic: true}' ;;
  esac
}

# digest NAME RAWLOG [CONFIG]
digest() {
  out="$work/replayed/$1"
  rm -rf "$out"
  status=0
  "$(program fastlio-replay)" ${3:+--config "$3"} --input-rawlog "$2" --output-dir "$out" \
    >"$work/replay.log" 2>&1 || status=$?
  echo "$1 exit $status"
  for file in trajectory.tum states.csv covariance.csv; do
    if [ -e "$out/$file" ]; then
      printf '%s %s %s\n' "$1" "$file" "$(sha256sum <"$out/$file" | cut -c 1-32)"
    else
      echo "$1 $file missing"
    fi
  done
}

mkdir -p "$work/simulated" "$work/replayed"
for scenario in $scenarios; do
  at="$work/simulated/$scenario"
  "$(program fastlio-sim)" --scenario "$scenario" --duration "$duration" --output-dir "$at" \
    >"$work/sim.log" 2>&1
  digest "sim_$scenario" "$at/recording.rawlog" "$at/config.yaml"
done
for variant in knn features motion extrinsic; do
  variant_keys "$variant" >"$work/$variant.yaml"
  digest "variant_$variant" "$work/simulated/office/recording.rawlog" "$work/$variant.yaml"
done
[ -n "$recordings" ] || exit 0
for recording in "$recordings"/*.rawlog; do
  digest "$(basename "$recording" .rawlog)" "$recording"
done
