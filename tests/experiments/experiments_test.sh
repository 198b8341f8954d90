#!/bin/sh
# mrpt_fastlio: the experiments print full rows, know every parameter they change, and refuse others.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: experiments_test.sh SOURCE_DIR BUILD_DIR OUTPUT_DIR
set -eu
experiments=$1/benchmarks/experiments
build=$2
output=$3
export SEEDS=1 DURATION=5

fail() {
  echo "$*" >&2
  exit 1
}

# Every variant of the ablation on a recording at rest: all parameters exist, all runs succeed.
SCENARIOS=rest "$experiments/ablation.sh" "$build" "$output" >"$output.ablation"
rows=$(grep -c ' ok |$' "$output.ablation" || true)
variants=$(sed -n "/^variants='/,/^'/p" "$experiments/ablation.sh" | grep -c '|')
[ "$rows" -ge 8 ] || fail "$rows rows of the ablation are ok: $(cat "$output.ablation")"
[ "$rows" -eq "$variants" ] || fail "$rows of $variants variants are ok: $(cat "$output.ablation")"
grep -qE '^\| default \| 0\.0[0-9]+ \| 0\.0[0-9]+ \|' "$output.ablation" ||
  fail "no errors in the row of the defaults: $(cat "$output.ablation")"

# A parameter that does not exist ends the experiment.
config=$output/recordings/rest-1-5s/config.yaml
change() { awk -v changes="$1" -f "$experiments/change_parameters.awk" "$config"; }
! (
  # shellcheck source=benchmarks/experiments/library.sh
  set -- "$build" "$output" && . "$experiments/library.sh" &&
    run "$output/recordings/rest-1-5s" "$output/unknown" update.no_such_parameter=1
) >/dev/null 2>&1 || fail "an unknown parameter was taken"
# A parameter of the file is changed, alone; another one is added.
changed=$(change "input.imu_sensor_label=other" | diff "$config" - | grep -c '^>' || true)
[ "$changed" -eq 1 ] || fail "$changed lines were changed"
change "update.max_iterations=17" | grep -qx '  max_iterations: 17' || fail "a parameter is not added"
change "gain=standard" | grep -qx 'gain: standard' || fail "a parameter without group is not changed"

# A table takes the place of the one before.
printf 'a\n<!-- begin t -->\nold\n<!-- end t -->\nb\n' >"$output/document.md"
echo new >"$output/table.md"
replace() { awk -v name="$1" -v table="$output/table.md" -f "$experiments/replace_table.awk" "$output/document.md"; }
[ "$(replace t | tr '\n' ' ')" = "a <!-- begin t --> new <!-- end t --> b " ] || fail "not replaced: $(replace t)"
! replace u >/dev/null 2>&1 || fail "a missing place was not reported"
