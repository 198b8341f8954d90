#!/bin/sh
# mrpt_fastlio: all benchmarks: stages alone, then whole runs.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/run.sh BUILD_DIR [RECORDINGS_DIR]     (without recordings: a simulated office)
set -eu

build=$1
recordings=${2:-}
here=$(cd "$(dirname "$0")" && pwd)
whole_run=$build/benchmarks/macro/fastlio-benchmark

"$build/benchmarks/micro/fastlio-microbenchmark" --benchmark_min_time=0.2

echo
if [ -z "$recordings" ]; then
  exec "$whole_run" --scenario office --duration 20 --header
fi
header=--header
for recording in "$recordings"/*.rawlog; do
  # One process each: the peak of its memory is the recording's own.
  "$whole_run" --recording "$recording" --config "$here/../params/velodyne_vlp16.yaml" $header
  header=
done
