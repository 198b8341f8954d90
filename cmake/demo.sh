#!/bin/sh
# mrpt_fastlio: a short simulated recording, the odometry on it, and its error against the truth.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: cmake/demo.sh BUILD_DIR OUTPUT_DIR
set -eu

build=$1
output=$2
scenario=${SCENARIO:-office}
duration=${DURATION:-30}
recording="$output/recording"
odometry="$output/odometry"

program() { echo "$build/apps/$1/$1"; }
step() { printf '\n== %s ==\n' "$*"; }

step "1/3 fastlio-sim: $duration s of '$scenario', with exact ground truth"
"$(program fastlio-sim)" --scenario "$scenario" --duration "$duration" --output-dir "$recording"

step "2/3 fastlio-replay: LiDAR-inertial odometry"
"$(program fastlio-replay)" --config "$recording/config.yaml" \
  --input-rawlog "$recording/recording.rawlog" --output-dir "$odometry"

step "3/3 fastlio-eval: the trajectory against the truth"
"$(program fastlio-eval)" --reference "$recording/ground_truth.tum" \
  --estimate "$odometry/trajectory.tum" --align yaw --plot "$output/trajectory.svg" \
  --json "$output/evaluation.json"

step "Files"
find "$output" -type f -printf '%12s bytes  %p\n' | sort -k 3
echo
echo "Look at the run:        $odometry/report.html (any browser)"
echo "Look at the trajectory: $output/trajectory.svg"
echo "Look at the map:        $odometry/map.ply (any point-cloud viewer)"
