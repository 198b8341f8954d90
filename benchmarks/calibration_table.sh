#!/bin/sh
# mrpt_fastlio: simulated rigs with realistic sensors, before and after fastlio-calibrate: two markdown tables.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/calibration_table.sh BUILD_DIR OUTPUT_DIR [SCENARIO...]     (default: office campus park)
# SEEDS (default: "1 2 ... 12") and DURATION (default: 40) in the environment.
set -eu

if [ $# -lt 2 ]; then
  sed -n '4,6s/^# //p' "$0" >&2
  exit 2
fi
build=$1
output=$2
shift 2
[ $# -gt 0 ] || set -- office campus park
seeds=${SEEDS:-1 2 3 4 5 6 7 8 9 10 11 12}

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

# The numbers of the truth in scenario.json: position of the LiDAR, matrices of gyro and accelerometer, by rows.
truth() {
  awk '
    /"T_imu_lidar"/ { pose = 1 }
    pose && /"position_m"/ { array = "position"; next }
    /"gyro_matrix"/ { array = "gyro"; next }
    /"accel_matrix"/ { array = "accelerometer"; next }
    array != "" && /[0-9]/ {
      gsub(/[ ,]/, "")
      print "truth." array "." n++, $0
      if ((array == "position" && n == 3) || n == 9) { array = ""; pose = 0; n = 0 }
    }' "$1"
  flatten "$1"
}

# How far the LiDAR, the clock and the gyro are from the truth; then how many of the values that have a standard
# deviation are within three of them, and how many there are.
calibration_errors() {
  {
    truth "$1/recording/scenario.json"
    flatten "$1/calibration.json" | sed 's/LiDAR in the IMU frame, /position_/; s/ scale /_scale_/
      s/^values.time offset (lidar.time_offset)/values.time/'
  } | awk '
    function error_of(name) { return value["values." name ".found"] - true_value[name] }
    { value[$1] = $2 }
    END {
      true_value["time"] = -1000 * value["truth.lidar_clock_minus_imu_clock_s"]
      for (axis = 0; axis < 3; ++axis) {
        letter = substr("xyz", axis + 1, 1)
        true_value["position_" letter] = 1000 * value["truth.position." axis]
        true_value["gyro_scale_" letter] = 100 * (value["truth.gyro." 4 * axis] - 1)
        true_value["accelerometer_scale_" letter] = 100 * (value["truth.accelerometer." 4 * axis] - 1)
        squares += error_of("position_" letter) ^ 2
      }
      for (name in true_value) {
        ++values
        if (error_of(name) ^ 2 <= 9 * value["values." name ".std"] ^ 2) ++within
      }
      printf "%.1f | %.2f | %.2f | %d of %d", sqrt(squares), error_of("time"), error_of("gyro_scale_z"), within, values
    }'
}

# Means of the rigs, by scenario, in the order of the first table.
means() {
  awk -F ' *[|] *' '
    {
      split($2, rig, ",")
      name = rig[1]
      if (!(name in count)) names[++scenarios] = name
      ++count[name]
      for (column = 3; column <= 11; ++column) sum[name, column] += (column > 8 ? $column ^ 2 : $column)
      split($12, part, " ")
      within[name] += part[1]
      values[name] += part[3]
    }
    END {
      for (s = 1; s <= scenarios; ++s) {
        name = names[s]
        row = "| " name " | " count[name]
        for (column = 3; column <= 11; ++column) {
          mean = sum[name, column] / count[name]
          digits = column == 3 || column == 6 ? 4 : column == 4 || column == 7 ? 3 : column == 10 || column == 11 ? 2 : 1
          row = row " | " sprintf("%.*f", digits, column > 8 ? sqrt(mean) : mean)
        }
        print row " | " within[name] " of " values[name] " |"
      }
    }' "$1"
}

measured="APE [m] | first [m] | NEES"
columns="$measured | calibrated: $measured | LiDAR off by [mm] | clock [ms] | gyro scale z [%] | within 3 std |"
echo "APE: RMSE, all poses aligned / first poses aligned. NEES of the pose: 6 when the covariance is true."
echo
echo "| rig | $columns"
echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
mkdir -p "$output"
: >"$output/rigs"
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
      "$(calibration_errors "$folder") |" | tee -a "$output/rigs"
  done
done

echo
echo "Means; of the three errors of the calibration: root mean squares."
echo
echo "| scenario | rigs | $columns"
echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
means "$output/rigs"
