#!/bin/sh
# mrpt_fastlio: long runs of the fuzzers.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: tests/fuzz/run.sh BUILD_DIR SECONDS [target...]
# Each target runs for SECONDS from the corpus in the repository; what is new goes to
# BUILD_DIR/fuzz/TARGET, what fails to BUILD_DIR/fuzz/TARGET-found-*, and the status is not zero.
set -eu
build=$1
seconds=$2
shift 2
here=$(dirname "$0")
mkdir -p "$build/fuzz"
status=0
for target in ${@:-rawlog packets cloud yaml ply pcd archive trajectory label external commandline \
  bag mcap database message capture metadata cloudfile}; do
  mkdir -p "$build/fuzz/$target"
  echo "== $target for $seconds s"
  "$build/tests/fuzz/fastlio-fuzz-$target" -max_total_time="$seconds" -rss_limit_mb=2048 \
    -timeout=20 -max_len=65536 -print_final_stats=1 -verbosity=0 \
    -artifact_prefix="$build/fuzz/$target-found-" \
    "$build/fuzz/$target" "$here/corpus/$target" 2>"$build/fuzz/$target.log" || status=1
  grep -E "^stat::|SUMMARY|found-" "$build/fuzz/$target.log" || true
done
exit $status
