#!/bin/sh
# mrpt_fastlio: simulated rides with realistic sensors, before and after fastlio-map, as one markdown table.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/map_table.sh BUILD_DIR OUTPUT_DIR [SCENARIO...]     (default: town facades corridors)
# SEEDS (default: "1 2") and SETTINGS (for fastlio-sim, default: --set lidar.stride=4) in the environment.
# GNSS=RATE adds a receiver with 1 m of noise, and the error of the map on the earth.
set -eu

if [ $# -lt 2 ]; then
  sed -n '4,7s/^# //p' "$0" >&2
  exit 2
fi
build=$1
output=$2
shift 2
[ $# -gt 0 ] || set -- town facades corridors
seeds=${SEEDS:-1 2}
settings="${SETTINGS:---set lidar.stride=4}${GNSS:+ --set gnss.rate=$GNSS}"

program() { echo "$build/bin/$1"; }
flatten() { awk -f "$(dirname "$0")/flatten_json.awk" "$1"; }

# errors TRUTH RUN: APE after alignment in heading and place, and in all; drift at the end, NEES of the pose.
errors() {
  "$(program fastlio-eval)" "$1" "$2/covariance.csv" --align yaw --json "$2.level.json" >/dev/null
  flatten "$2.level.json" | awk '$1 == "ape.translation_m.rmse" { printf "%.3f | ", $2 }'
  "$(program fastlio-eval)" "$1" "$2/covariance.csv" --json "$2.json" >/dev/null
  flatten "$2.json" | awk '
    { value[$1] = $2 }
    END {
      printf "%.3f | %.3f | %.1f", value["ape.translation_m.rmse"], value["end_to_end_drift.translation_m"],
        value["nees.pose.mean"]
    }'
}

# on_earth FOLDER: two more columns, horizontal and vertical error.
on_earth() {
  [ -z "${GNSS:-}" ] ||
    echo " $(awk -f "$(dirname "$0")/earth_error.awk" "$1/recording/scenario.json" "$1/map/summary.json" \
      "$1/recording/ground_truth.tum" "$1/map/covariance.csv") |"
}

echo "| scenario | seed | odometry: level [m] | APE [m] | end [m] | NEES | map: level [m] | APE [m] | end [m] | NEES | closures |${GNSS:+ earth: horizontal [m] | vertical [m] |}"
echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|${GNSS:+--:|--:|}"
for scenario in "$@"; do
  for seed in $seeds; do
    folder=$output/$scenario-$seed
    # shellcheck disable=SC2086  # several words
    "$(program fastlio-sim)" "$scenario" --realistic --seed "$seed" $settings -q --overwrite -o "$folder/recording"
    "$(program fastlio-replay)" -c "$folder/recording/config.yaml" --frame imu -q --overwrite --export covariance \
      -o "$folder/replay" "$folder/recording/recording.rawlog" >/dev/null 2>&1 || true
    "$(program fastlio-map)" -c "$folder/recording/config.yaml" --frame imu -q --overwrite --export covariance,report \
      -o "$folder/map" "$folder/recording/recording.rawlog" || true
    truth=$folder/recording/ground_truth.tum
    accepted=$(flatten "$folder/map/summary.json" | awk '$1 == "closures_accepted" { print $2 }')
    echo "| $scenario | $seed | $(errors "$truth" "$folder/replay") | $(errors "$truth" "$folder/map") | $accepted |$(on_earth "$folder")"
    rm -f "$folder/recording/recording.rawlog"
  done
done
