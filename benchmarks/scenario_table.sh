#!/bin/sh
# mrpt_fastlio: every simulated scenario through the programs, and its errors as one markdown table.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/scenario_table.sh BUILD_DIR OUTPUT_DIR [SCENARIO...]     (default: all of them)
# SEED and DURATION in the environment are passed on to fastlio-sim.
set -eu

if [ $# -lt 2 ]; then
  sed -n '4,6s/^# //p' "$0" >&2
  exit 2
fi
build=$1
output=$2
shift 2

program() { echo "$build/bin/$1"; }

all_scenarios() { "$(program fastlio-sim)" --list | awk '/^  [a-z_]+ / { print $1 }'; }

# Sets $status to what fastlio-replay says about the run.
run_scenario() {
  mkdir -p "$2"
  "$(program fastlio-sim)" --scenario "$1" --output-dir "$2/recording" --seed "${SEED:-1}" \
    ${DURATION:+--duration "$DURATION"} >"$2/sim.log" 2>&1
  status=0
  "$(program fastlio-replay)" --config "$2/recording/config.yaml" --frame imu \
    --input-rawlog "$2/recording/recording.rawlog" --output-dir "$2/odometry" \
    >"$2/replay.log" 2>&1 || status=$?
  "$(program fastlio-eval)" "$2/recording/ground_truth.tum" "$2/odometry/covariance.csv" \
    --align first --json "$2/evaluation.json" >"$2/evaluation.txt" 2>&1
}

flatten() { awk -f "$(dirname "$0")/flatten_json.awk" "$1"; }

row() {
  flatten "$2" | awk -v scenario="$1" -v status="$3" '
    { value[$1] = $2 }
    function number(path, digits) {
      return path in value && value[path] != "null" ? sprintf("%." digits "f", value[path]) : "-"
    }
    END {
      printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", scenario,
        number("duration_s", 0), number("path_length_m", 1),
        number("ape.translation_m.rmse", 4), number("ape.translation_m.max", 4),
        number("end_to_end_drift.translation_m", 4), number("end_to_end_drift.percent", 3),
        number("ape.rotation_deg.rmse", 3),
        number("nees.position.mean", 1), number("nees.rotation.mean", 1),
        status == 0 ? "ok" : "exit " status
    }'
}

[ $# -gt 0 ] || set -- $(all_scenarios)
echo "First poses aligned. NEES: mean over the run, 3 when the covariance is true."
echo
echo "| scenario | length [s] | path [m] | APE RMSE [m] | APE max [m] | drift [m] | drift [%] | APE rotation [deg] | NEES position | NEES rotation | fastlio-replay |"
echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|"
for scenario in "$@"; do
  if run_scenario "$scenario" "$output/$scenario"; then
    row "$scenario" "$output/$scenario/evaluation.json" "$status"
  else
    echo "| $scenario | failed, see $output/$scenario/*.log |"
    failed=1
  fi
done
exit "${failed:-0}"
