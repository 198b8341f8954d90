#!/bin/sh
# mrpt_fastlio: counts the instructions of a fixed run of the odometry and compares them with a budget.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: tests/instructions/check_instructions.sh PROGRAM BUDGET_FILE [NATIVE]
#
# The budget has a line per module: instructions per scan in its library, in thousands, and its name; "all" is the
# whole run with all other libraries. The names of modules stay when functions in them are renamed, split or inlined. A
# count may exceed its budget by a tenth, which other compilers and libraries need. The modules of the
# estimator count as one: they have the same products of Eigen, and the linker decides whose copies are used.
# Exit status 77: not counted.
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
valgrind --tool=callgrind --callgrind-out-file="$work/profile" \
  --toggle-collect=fastlioCountedRun "$program" >"$work/output" 2>"$work/log" || {
  cat "$work/output" "$work/log" >&2
  exit 1
}
# Lines "COUNT (SHARE%)  FILE:FUNCTION [LIBRARY]".
callgrind_annotate --inclusive=no --threshold=100 "$work/profile" >"$work/functions"
scans=$(sed -n 's/ scans tracked$//p' "$work/output")

awk -v scans="$scans" '
  FNR == NR {
    if ($0 ~ /^#/ || NF < 2) next
    limit[++count] = $1; name[count] = $2
    next
  }
  $1 ~ /^[0-9][0-9,]*$/ {
    number = $1; gsub(",", "", number)
    if ($0 ~ /PROGRAM TOTALS/) { measured["all"] = number / scans / 1000; next }
    if (match($0, /libmrpt_fastlio_[a-z]+\.so[^\/]*\]/)) {
      module = substr($0, RSTART + length("libmrpt_fastlio_"))
      sub(/\.so.*/, "", module)
      if (module ~ /^(filter|imu|math|interface|matching|errormodel|initialization|localmap|health|odometry)$/) module = "estimator"
      measured[module] += number / scans / 1000
    }
  }
  END {
    printf "%-12s %10s %10s   thousand instructions per scan\n", "module", "budget", "counted"
    for (i = 1; i <= count; ++i) {
      module = name[i]
      found = module in measured
      printf "%-12s %10d %10d", module, limit[i], measured[module]
      if (!found) { printf "   not found: has it another name now?"; bad = 1 }
      else if (measured[module] > 1.1 * limit[i]) { printf "   above its budget"; bad = 1 }
      else if (measured[module] < 0.8 * limit[i]) printf "   well below: lower the budget"
      printf "\n"
      delete measured[module]
    }
    for (module in measured)
      if (measured[module] > 20) {
        printf "%-12s %10s %10d   is not in the budget\n", module, "-", measured[module]
        bad = 1
      }
    exit bad
  }' "$budget" "$work/functions"
