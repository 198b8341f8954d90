#!/bin/sh
# mrpt_fastlio: simulated rigs with realistic sensors, before and after fastlio-calibrate, as one markdown table.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/calibration_table.sh BUILD_DIR OUTPUT_DIR [SCENARIO...]     (default: office campus park)
# SEEDS (default: "1 2 3") and DURATION (default: 40) in the environment.
set -eu

if [ $# -lt 2 ]; then
  sed -n '4,6s/^# //p' "$0" >&2
  exit 2
fi
build=$1
output=$2
shift 2
[ $# -gt 0 ] || set -- office campus park
seeds=${SEEDS:-1 2 3}

program() { echo "$build/bin/$1"; }
flatten() { awk -f "$(dirname "$0")/flatten_json.awk" "$1"; }

# replay FOLDER PARAMETERS NAME: evaluations of a run, with the first poses aligned and with all poses aligned.
replay() {
  "$(program fastlio-replay)" -c "$2" --frame imu --input-rawlog "$1/recording/recording.rawlog" \
    --output-dir "$1/$3" --overwrite >"$1/$3.log" 2>&1 || true
  "$(program fastlio-eval)" "$1/recording/ground_truth.tum" "$1/$3/covariance.csv" \
    --align first --json "$1/$3.first.json" >/dev/null
  "$(program fastlio-eval)" "$1/recording/ground_truth.tum" "$1/$3/covariance.csv" \
    --json "$1/$3.json" >/dev/null
}

# Columns: APE after alignment, APE with the first poses aligned, NEES of the pose.
errors() {
  {
    flatten "$1.json" | sed 's/^/aligned./'
    flatten "$1.first.json" | sed 's/^/first./'
  } | awk '
    { value[$1] = $2 }
    END {
      printf "%.4f | %.3f | %.1f", value["aligned.ape.translation_m.rmse"],
        value["first.ape.translation_m.rmse"], value["first.nees.pose.mean"]
    }'
}

# The numbers of the truth in scenario.json: position of the LiDAR, matrix of the gyro, by rows.
truth() {
  awk '
    /"T_imu_lidar"/ { pose = 1 }
    pose && /"position_m"/ { array = "position"; next }
    /"gyro_matrix"/ { array = "gyro"; next }
    array != "" && /[0-9]/ {
      gsub(/[ ,]/, "")
      print "truth." array "." n++, $0
      if ((array == "position" && n == 3) || n == 9) { array = ""; pose = 0; n = 0 }
    }' "$1"
  flatten "$1"
}

# How far the LiDAR, the clock and the gyro are from the truth.
calibration_errors() {
  {
    truth "$1/recording/scenario.json"
    flatten "$1/calibration.json" | sed 's/gyro scale z/gyro_scale_z/; s/LiDAR in the IMU frame, /position_/; s/^values.time offset (lidar.time_offset)/values.time/'
  } | awk '
    { value[$1] = $2 }
    END {
      for (axis = 0; axis < 3; ++axis)
        squares += (value["values.position_" substr("xyz", axis + 1, 1) ".found"] - 1000 * value["truth.position." axis]) ^ 2
      printf "%.1f | %.2f | %.2f", sqrt(squares),
        value["values.time.found"] + 1000 * value["truth.lidar_clock_minus_imu_clock_s"],
        value["values.gyro_scale_z.found"] - 100 * (value["truth.gyro.8"] - 1)
    }'
}

echo "APE: RMSE, all poses aligned / first poses aligned. NEES of the pose: 6 when the covariance is true."
echo
echo "| rig | APE [m] | first [m] | NEES | calibrated: APE [m] | first [m] | NEES | LiDAR off by [mm] | clock [ms] | gyro scale z [%] |"
echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
for scenario in "$@"; do
  for seed in $seeds; do
    folder="$output/$scenario-$seed"
    mkdir -p "$folder"
    "$(program fastlio-sim)" --scenario "$scenario" --realistic --seed "$seed" --duration "${DURATION:-40}" \
      --output-dir "$folder/recording" --overwrite >"$folder/sim.log" 2>&1
    replay "$folder" "$folder/recording/config.yaml" given
    "$(program fastlio-calibrate)" -q --no-trial -c "$folder/recording/config.yaml" -o "$folder/calibration.yaml" \
      --json "$folder/calibration.json" "$folder/recording/recording.rawlog" || true
    replay "$folder" "$folder/calibration.yaml" calibrated
    echo "| $scenario, seed $seed | $(errors "$folder/given") | $(errors "$folder/calibrated") |" \
      "$(calibration_errors "$folder") |"
  done
done
