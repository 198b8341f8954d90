#!/bin/sh
# mrpt_fastlio: what each of ten keys, alone, does to the error of four platforms, as a markdown table.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/tune_effects.sh BUILD_DIR OUTPUT_DIR
# Simulated, two recordings a platform with realistic sensors. DURATION (default: 20) and JOBS in the environment.
set -eu

if [ $# -lt 2 ]; then
  sed -n '5,6s/^# //p' "$0" >&2
  exit 2
fi
build=$1
output=$2
mkdir -p "$output"
program() { echo "$build/bin/$1"; }

cat >"$output/space.yaml" <<'END'
imu:
  gyro_noise_density: [0.0001, 0.0005, 0.002, 0.01]
  accel_noise_density: [0.001, 0.005, 0.02, 0.1]
lidar:
  min_range: [0.5, 2]
  max_range: [20, 50, 150]
  time_offset: [-0.01, 0, 0.01]
calibration:
  estimate_time_offset: [true, false]
  estimate_extrinsic: [true, false]
downsampling:
  target_points: [500, 1500, 4000]
measurement:
  range_noise: [0.005, 0.02, 0.08]
map:
  voxel_size: [0.2, 0.4, 0.8, 1.6]
END
echo "| platform | key | effect | values and their errors, 1: the default's |"
echo "|---|---|--:|---|"
for platform in indoor:office outdoor:campus vehicle:car drone:uav; do
  name=${platform%:*}
  for seed in 1 2; do
    [ -e "$output/$name$seed.rawlog" ] || {
      "$(program fastlio-sim)" "${platform#*:}" -o "$output/sim" --overwrite --realistic --duration "${DURATION:-20}" -q \
        --seed "$seed" --set lidar.stride=2
      mv "$output/sim/ground_truth.tum" "$output/$name$seed.gt.tum"
      mv "$output/sim/recording.rawlog" "$output/$name$seed.rawlog"
    }
  done
  status=0
  "$(program fastlio-tune)" "$output/space.yaml" "$output/${name}1.rawlog" "$output/${name}2.rawlog" --method each \
    --frame imu -j "${JOBS:-$(nproc)}" -o "$output/$name.yaml" -q >"$output/$name.txt" || status=$?
  # 2 and 3: no key alone makes both recordings better.
  [ "$status" -eq 0 ] || [ "$status" -eq 2 ] || [ "$status" -eq 3 ] || exit "$status"
  sed -n '/^Effect of each key/,/^$/p' "$output/$name.txt" |
    sed -n "s/^  \([a-z_.]*\): \([0-9.]*\); \(.*\)/| $name | \`\1\` | \2 | \3 |/p" | sort -t'|' -k4,4nr
done
