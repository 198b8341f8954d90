#!/bin/sh
# mrpt_fastlio: fastlio-tune as a user calls it: --help and bad input.
# SPDX-License-Identifier: BSD-3-Clause
set -eu
tune=$1
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
expect() { # STATUS TEXT COMMAND...
  status=$1 text=$2
  shift 2
  seen=0
  "$@" >"$dir/log" 2>&1 || seen=$?
  [ "$seen" -eq "$status" ] && grep -q -- "$text" "$dir/log" || { echo "status $seen: $*"; cat "$dir/log"; exit 1; }
}
printf 'lidar:\n  min_rnge: [1]\n' >"$dir/bad.yaml"
printf 'lidar:\n  min_range: [0.5, 1]\n' >"$dir/good.yaml"
expect 0 'Exit status' "$tune" --help
expect 1 'a recording' "$tune" "$dir/good.yaml"
expect 1 'lidar.min_range' "$tune" "$dir/bad.yaml" "$dir/a.rawlog"
expect 1 'a.rawlog' "$tune" "$dir/good.yaml" "$dir/a.rawlog" -o "$dir/o.yaml"
# Folders may be recordings: whether one is shows before the runs.
expect 1 "is a folder in which no recording was found" "$tune" "$dir/good.yaml" "$dir" -o "$dir/o.yaml"
expect 1 'method' "$tune" "$dir/good.yaml" "$dir/a.rawlog" --method luck
# Recordings first: said in words.
printf '\001\002\003 a recording' >"$dir/b.rawlog"
expect 1 'give the search space first' "$tune" "$dir/b.rawlog" "$dir/good.yaml"
! grep -q memory "$dir/log" || { cat "$dir/log"; exit 1; }
printf 'lidar:\n\tmin_range: [1]\n' >"$dir/tab.yaml"
expect 1 'line 2 begins with a tab; use spaces' "$tune" "$dir/tab.yaml" "$dir/b.rawlog"
# Parameters of somebody stay.
printf 'map:\n  voxel_size: 0.3\n' >"$dir/own.yaml"
expect 1 "own.yaml' is there already, and fastlio-tune did not write it" \
  "$tune" "$dir/good.yaml" "$dir/b.rawlog" -o "$dir/own.yaml"
grep -q 'voxel_size: 0.3' "$dir/own.yaml"
# And so does a page of somebody, whose name follows from --output.
printf '<!DOCTYPE html>\n<title>Mine</title>\n' >"$dir/page.html"
expect 1 "page.html' is there already, and fastlio-tune did not write it" \
  "$tune" "$dir/good.yaml" "$dir/b.rawlog" -o "$dir/page.yaml"
grep -q 'Mine' "$dir/page.html"
