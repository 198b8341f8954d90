#!/bin/bash
# mrpt_fastlio: runs the commands of a page of the documentation, line by line, in a folder with a recording walk.rawlog.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: run_page.sh PAGE.md PROGRAMS_DIR WORK_DIR FILE...      lines in ```sh blocks are commands; the files must exist then
set -u

page=$(realpath "$1"); export PATH; PATH="$(realpath "$2"):$PATH"; work=$3
shift 3
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
fastlio-sim --scenario office --duration 8 --output-dir simulated --quiet || exit 1
mv simulated/recording.rawlog walk.rawlog

commands=0
while IFS= read -r line; do
  [ -n "$line" ] || continue
  echo "+ $line"
  if ! bash -c "$line" </dev/null >log.txt 2>&1; then
    tail -40 log.txt
    echo "FAILED: $line" >&2
    exit 1
  fi
  commands=$((commands + 1))
done < <(awk '/^```sh$/ { on = 1; next } /^```/ { on = 0 } on' "$page")

for file in "$@"; do
  [ -s "$file" ] || { echo "FAILED: no $file" >&2; exit 1; }
done
echo "$commands commands"
[ "$commands" -gt 0 ]
