#!/bin/sh
# mrpt_fastlio: all experiments; writes their tables into docs/experiments.md, all at once when the last one is done.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/experiments/all.sh BUILD_DIR OUTPUT_DIR [NAME...]     (default: all of them)
set -eu

if [ $# -lt 2 ]; then
  sed -n '5s/^# //p' "$0" >&2
  exit 2
fi
here=$(cd "$(dirname "$0")" && pwd)
document=$here/../../docs/experiments.md
build=$1
output=$2
shift 2

# What the figures belong to.
conditions() {
  echo "Commit $(git -C "$here" rev-parse --short HEAD 2>/dev/null || echo unknown)," \
    "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), recordings with the seeds" \
    "${SEEDS:-1 2 3}. Load of the machine at the start: $(cut -d ' ' -f 1 /proc/loadavg); times are" \
    "those of the method alone when it is near zero."
}

table() {
  case $1 in
    conditions) conditions ;;
    gain_cost) "$build/benchmarks/experiments/fastlio-gain-cost" ;;
    *) "$here/$1.sh" "$build" "$output" ;;
  esac
}

[ $# -gt 0 ] || set -- gain_cost outdoor_loop large_rotation open_area_gains scan_rates ablation
mkdir -p "$output/tables"
for name in conditions "$@"; do
  echo "$name" >&2
  table "$name" >"$output/tables/$name.md.tmp"
  mv "$output/tables/$name.md.tmp" "$output/tables/$name.md"
  cat "$output/tables/$name.md"
done

# A run that is cut short leaves the document as it was: its conditions belong to all of its tables.
trap 'rm -f "$document.tmp" "$document.new"' EXIT
cp "$document" "$document.tmp"
for name in conditions "$@"; do
  awk -v name="$name" -v table="$output/tables/$name.md" -f "$here/replace_table.awk" \
    "$document.tmp" >"$document.new"
  mv "$document.new" "$document.tmp"
done
mv "$document.tmp" "$document"
