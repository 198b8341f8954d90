# mrpt_fastlio: what the experiments share: recordings, runs with changed parameters, rows of tables.
# SPDX-License-Identifier: BSD-3-Clause
#
# Sourced by the experiments with their arguments: BUILD_DIR OUTPUT_DIR. SEEDS in the environment
# says which recordings of a scenario are made (default: 1 2 3); a row is the mean over them.
# DURATION [s] cuts all recordings short.
# shellcheck shell=sh
set -eu

if [ $# -ne 2 ]; then
  echo "Usage: $0 BUILD_DIR OUTPUT_DIR" >&2
  exit 2
fi
build=$1
output=$2
seeds=${SEEDS:-1 2 3}
library=$(cd "$(dirname "$0")" && pwd)

program() { echo "$build/apps/$1/$1"; }

# recording NAME SCENARIO SEED [OPTION...]: prints the folder of a recording, made with fastlio-sim
# unless an earlier experiment of the same build did.
recording() {
  folder=$output/recordings/$1-$3${DURATION:+-${DURATION}s}
  if [ ! "$folder/recording.rawlog" -nt "$(program fastlio-sim)" ]; then
    scenario=$2 seed=$3
    mkdir -p "$folder"
    shift 3
    "$(program fastlio-sim)" "$scenario" --seed "$seed" --output-dir "$folder" \
      ${DURATION:+--duration "$DURATION"} "$@" >"$folder/sim.log" 2>&1 || { cat "$folder/sim.log" >&2; return 1; }
  fi
  echo "$folder"
}

# run RECORDING FOLDER [KEY=VALUE...]: the odometry on a recording with some parameters changed, and
# its errors. Timings are of one thread.
run() {
  from=$1 to=$2
  shift 2
  mkdir -p "$to"
  awk -v changes="$*" -f "$library/change_parameters.awk" "$from/config.yaml" >"$to/config.yaml"
  # A key that there is not any more ends the experiment.
  "$(program fastlio-replay)" --config "$to/config.yaml" --dump-config >"$to/effective.yaml" || return 1
  "$(program fastlio-replay)" --config "$to/config.yaml" --frame imu --threads 1 \
    --input-rawlog "$from/recording.rawlog" --output-dir "$to" >"$to/replay.log" 2>&1 || true
  "$(program fastlio-eval)" "$from/ground_truth.tum" "$to/covariance.csv" --align first \
    --json "$to/evaluation.json" >"$to/evaluation.txt" 2>&1 || true
}

# variant LABEL NAME SCENARIO SIM_OPTIONS [KEY=VALUE...]: runs all seeds of a scenario with some
# parameters changed and prints the table row. SIM_OPTIONS may be empty.
variant() {
  label=$1 name=$2 scenario=$3 options=$4
  shift 4
  runs=
  for seed in $seeds; do
    # shellcheck disable=SC2086  # several options
    source=$(recording "$name" "$scenario" "$seed" $options)
    target=$output/runs/$(echo "$label-$name-$seed" | tr -c 'A-Za-z0-9_.\n-' '_')
    run "$source" "$target" "$@"
    runs="$runs $target"
  done
  # shellcheck disable=SC2086
  row "$label" $runs
}

header() {
  echo "| $1 | APE RMSE [m] | APE max [m] | drift [m] | drift [%] | APE rotation [deg] | NEES pose | points | median [ms] | p99 [ms] | outcome |"
  echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|"
}

# row LABEL RUN...
row() {
  label=$1
  shift
  for folder in "$@"; do
    echo "run $folder"
    for document in "$folder/evaluation.json" "$folder/summary.json"; do
      [ -f "$document" ] && awk -f "$library/../flatten_json.awk" "$document"
    done
  done | awk -v label="$label" -f "$library/table_row.awk"
}
