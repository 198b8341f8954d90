#!/bin/sh
# mrpt_fastlio: how well the proxy of fastlio-tune ranks parameter sets, on recordings with ground truth.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/tune_proxy.sh BUILD_DIR OUTPUT_DIR [RECORDINGS_DIR...]
# Recordings are simulated with realistic sensors, and NAME.rawlog with NAME.gt.tum in the folders.
# BUDGET (default: 40 parameter sets) and JOBS in the environment.
set -eu

if [ $# -lt 2 ]; then
  sed -n '4,7s/^# //p' "$0" >&2
  exit 2
fi
build=$1
output=$2
shift 2
mkdir -p "$output"
program() { echo "$build/bin/$1"; }

given=$#
for scenario in office campus uav stairs car; do
  [ -e "$output/$scenario.rawlog" ] || {
    "$(program fastlio-sim)" "$scenario" -o "$output/sim_$scenario" --overwrite --realistic --duration 25 -q --seed 7 \
      --set lidar.stride=2
    mv "$output/sim_$scenario/ground_truth.tum" "$output/$scenario.gt.tum"
    mv "$output/sim_$scenario/recording.rawlog" "$output/$scenario.rawlog"
  }
  set -- "$@" "$output/$scenario.rawlog"
done
for number in $(seq "$given"); do
  folder=$1
  shift
  for recording in "$folder"/*.rawlog; do
    [ ! -e "${recording%.rawlog}.gt.tum" ] || set -- "$@" "$recording"
  done
done
cat >"$output/space.yaml" <<'END'
imu:
  gyro_noise_density: {min: 0.00005, max: 0.01, scale: log}
  accel_noise_density: {min: 0.0005, max: 0.1, scale: log}
lidar:
  time_offset: {min: -0.012, max: 0.012}
measurement:
  range_noise: {min: 0.005, max: 0.2, scale: log}
map:
  voxel_size: {min: 0.2, max: 1.2, scale: log}
downsampling:
  target_points: {min: 250, max: 3000, scale: log}
END
"$(program fastlio-tune)" "$output/space.yaml" "$@" --rank --frame imu --budget "${BUDGET:-40}" -j "${JOBS:-$(nproc)}" \
  -o "$output/rank.yaml"
