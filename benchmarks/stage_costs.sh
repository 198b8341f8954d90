#!/bin/sh
# mrpt_fastlio: instructions and cache misses of each stage of the odometry, per scan, counted by valgrind.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/stage_costs.sh BUILD_DIR RECORDING.rawlog...
# BUILD_DIR: of a build for the baseline of the processor family, with the benchmarks. The caches are simulated: 48 kB of
# the first level, 2 MB of the last, as one core has them for itself.
set -eu

if [ $# -lt 2 ]; then
  sed -n '4,7s/^# //p' "$0" >&2
  exit 2
fi
build=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Inclusive counts of the functions that are the stages. "update" is what iterating needs beside the association.
stages() {
  callgrind_annotate --inclusive=yes --threshold=100 --show=Ir,D1mr,D1mw,DLmr,DLmw "$1" | awk -v scans="$2" -v name="$3" '
    function stage(pattern) {
      if ($0 ~ /PROGRAM TOTALS/ || index($0, "fastlio::" pattern) == 0) return 0
      return $0 !~ /lambda|callOf|Workers::/
    }
    function note(what,    i, n, field) {
      if (what in seen) return
      seen[what] = 1
      line = $0
      gsub(/\([^)]*%\)/, "", line)
      gsub(/,/, "", line)
      split(line, field, " ")
      for (i = 1; i <= 5; ++i) cost[what, i] = field[i] == "." ? 0 : field[i]
    }
    stage("Estimator::process(") { note("all") }
    stage("Estimator::downsample(") { note("downsample") }
    stage("Estimator::deskew(") { note("deskew") }
    stage("ScanMatcher::associate(") { note("match") }
    stage("iteratedUpdate(") { note("update") }
    stage("Estimator::adopt(") { note("errors") }
    stage("Estimator::insertIntoMap(") { note("insert") }
    END {
      for (i = 1; i <= 5; ++i) cost["update", i] -= cost["match", i]
      n = split("downsample deskew match update errors insert", order, " ")
      for (i = 1; i <= 5; ++i) {
        cost["propagate and the rest", i] = cost["all", i]
        for (k = 1; k <= n; ++k) cost["propagate and the rest", i] -= cost[order[k], i]
      }
      order[++n] = "propagate and the rest"
      order[++n] = "all"
      for (k = 1; k <= n; ++k)
        printf "| %s | %s | %.0f | %.1f | %.2f | %.0f |\n", name, order[k], cost[order[k], 1] / scans / 1000,
          (cost[order[k], 2] + cost[order[k], 3]) / scans / 1000, (cost[order[k], 4] + cost[order[k], 5]) / scans / 1000,
          (cost[order[k], 4] + cost[order[k], 5]) * 64 / scans / 1000
    }'
}

echo "| recording | stage | thousand instructions | thousand L1 misses | thousand misses of the last cache | kB from memory |"
echo "|---|---|--:|--:|--:|--:|"
for recording in "$@"; do
  valgrind --tool=callgrind --cache-sim=yes --I1=32768,8,64 --D1=49152,12,64 --LL=2097152,16,64 \
    --callgrind-out-file="$work/profile" --toggle-collect='fastlio::Estimator::process*' \
    "$build/benchmarks/macro/fastlio-benchmark" --recording "$recording" --threads 1 --repeats 1 >"$work/run" 2>"$work/log"
  # The run is repeated once: streamed from the file, and from memory.
  scans=$(awk -F'|' 'END { print 2 * $3 }' "$work/run")
  stages "$work/profile" "$scans" "$(basename "$recording" .rawlog)"
done
