#!/bin/sh
# mrpt_fastlio: fastlio-tune makes a deliberately bad parameter file better, on simulated recordings.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: cmake/tune_demo.sh BUILD_DIR OUTPUT_DIR
set -eu

build=$1
output=$2
jobs=${JOBS:-2}
program() { echo "$build/bin/$1"; }
step() { printf '\n== %s ==\n' "$*"; }
mkdir -p "$output"

step "1/4 three recordings for the search, one that is kept back; the LiDAR's clock is 15 ms late"
for part in first:0 second:12 third:24 kept_back:36; do
  name=${part%:*}
  "$(program fastlio-sim)" office -o "$output/sim_$name" --overwrite -q --realistic --duration 12 --rest 2 \
    --seed "1${part#*:}" --set "path_start=${part#*:}" --set lidar.stride=2 --time-offset 0.015
  cp "$output/sim_$name/recording.rawlog" "$output/$name.rawlog"
  cp "$output/sim_$name/ground_truth.tum" "$output/$name.gt.tum"
done

step "2/4 a bad parameter file, and what may change"
cat >"$output/bad.yaml" <<'END'
lidar:
  time_offset: 0.01
calibration:
  estimate_time_offset: false
measurement:
  range_noise: 0.05
map:
  voxel_size: 1.2
END
cat >"$output/space.yaml" <<'END'
lidar:
  time_offset: {min: -0.03, max: 0.03}
measurement:
  range_noise: {min: 0.005, max: 0.3, scale: log}
map:
  voxel_size: {min: 0.2, max: 2, scale: log}
END
cat "$output/bad.yaml" "$output/space.yaml"

step "3/4 fastlio-tune"
rm -f "$output/tuned.yaml.sqlite"
"$(program fastlio-tune)" "$output/space.yaml" "$output/first.rawlog" "$output/second.rawlog" "$output/third.rawlog" \
  -c "$output/bad.yaml" -o "$output/tuned.yaml" --budget 28 -j "$jobs"

step "4/4 before and after, on the recording that was kept back"
for parameters in bad tuned; do
  status=0
  "$(program fastlio-replay)" "$output/kept_back.rawlog" -c "$output/$parameters.yaml" -o "$output/$parameters" \
    --overwrite -q || status=$?
  # 4: diverged, 6: degraded; that of bad parameters may be.
  case "$status" in 0 | 4 | 6) ;; *) exit "$status" ;; esac
done
"$(program fastlio-eval)" "$output/kept_back.gt.tum" "$output/bad" "$output/tuned"
