#!/bin/sh
# mrpt_fastlio: counts the instructions of a fixed run of the odometry and compares them with a budget.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: tests/instructions/check_instructions.sh PROGRAM BUDGET_FILE [NATIVE]
#
# The budget has a line per function: instructions per scan in it and below it, in thousands, and its name. A
# count may exceed its budget by a tenth, which other compilers and libraries need. Exit status 77: not counted.
set -eu

program=$1
budget=$2
if [ "${3:-OFF}" = ON ]; then
  echo "Not counted: this build is optimised for the machine at hand, whose instructions valgrind may not know."
  echo "'make instructions' counts in a build for the baseline of the processor family."
  exit 77
fi
if ! command -v valgrind >/dev/null; then
  echo "Not counted: valgrind is not installed (Debian package: valgrind)."
  exit 77
fi

if [ ! -x "$program" ]; then
  echo "Not counted: the program is built by 'make instructions' only."
  exit 77
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Counting starts and stops with each scan: simulating the recording is left out. The whole name, as a lambda of the function
# would stop the counting.
process='fastlio::ScanPipeline::process(fastlio::LidarScan const&, fastlio::ScanSpan const&, fastlio::ImuBuffer const&)'
valgrind --tool=callgrind --callgrind-out-file="$work/profile" \
  --toggle-collect="$process" "$program" >"$work/output" 2>"$work/log" || {
  cat "$work/output" "$work/log" >&2
  exit 1
}
callgrind_annotate --inclusive=yes --threshold=100 "$work/profile" >"$work/functions"
scans=$(sed -n 's/ scans tracked$//p' "$work/output")

awk -v scans="$scans" '
  FNR == NR {
    if ($0 ~ /^#/ || NF < 2) next
    limit[++count] = $1; name[count] = $2
    next
  }
  {
    for (i = 1; i <= count; ++i)
      if (!(i in measured) && index($0, "fastlio::" name[i] "(")) {
        number = $1; gsub(",", "", number)
        measured[i] = number / scans / 1000
      }
  }
  END {
    printf "%-28s %10s %10s   thousand instructions per scan\n", "function", "budget", "counted"
    for (i = 1; i <= count; ++i) {
      printf "%-28s %10d %10d", name[i], limit[i], measured[i]
      if (!(i in measured)) { printf "   not found: has it another name now?"; bad = 1 }
      else if (measured[i] > 1.1 * limit[i]) { printf "   above its budget"; bad = 1 }
      else if (measured[i] < 0.8 * limit[i]) printf "   well below: lower the budget"
      printf "\n"
    }
    exit bad
  }' "$budget" "$work/functions"
