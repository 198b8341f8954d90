#!/bin/sh
# mrpt_fastlio: how fast a recording is replayed and imported from each format.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/formats.sh BUILD_DIR RECORDING.rawlog...
# The best of five runs each. Where a machine does other things: chrt --rr 1 benchmarks/formats.sh ...
set -eu

if [ $# -lt 2 ]; then
  sed -n '5s/^# //p' "$0" >&2
  exit 2
fi
programs=$(cd "$1/bin" && pwd)
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# replay FILE: times real time, the best of five
replay() {
  for _ in 1 2 3 4 5; do
    "$programs/fastlio-replay" "$1" -o "$work/run" --overwrite --export trajectory 2>&1 |
      sed -n 's/^Speed *\([0-9.]*\) x real time.*/\1/p'
  done | sort -g | tail -n 1
}

# import FILE: milliseconds to a plain rawlog, the best of five
import() {
  for _ in 1 2 3 4 5; do
    begin=$(date +%s%N)
    "$programs/fastlio-import" "$1" -o "$work/imported.rawlog" --compression none --overwrite --quiet
    echo $((($(date +%s%N) - begin) / 1000000))
  done | sort -g | head -n 1
}

echo "| recording | format | MB | replay, x real time | import to a plain rawlog [ms] |"
echo "|---|---|--:|--:|--:|"
for recording in "$@"; do
  name=$(basename "$recording" .rawlog)
  for format in none zstd gzip mcap; do
    file=$work/recording.rawlog
    if [ "$format" = mcap ]; then
      file=$work/recording.mcap
      "$programs/fastlio-import" "$recording" -o "$file" --overwrite --quiet
    else
      "$programs/fastlio-import" "$recording" -o "$file" --compression "$format" --overwrite --quiet
    fi
    label="rawlog, $format"
    [ "$format" = mcap ] && label='MCAP, zstd'
    echo "| $name | $label | $(du -BM "$file" | sed 's/M.*//') | $(replay "$file") | $(import "$file") |"
  done
done
