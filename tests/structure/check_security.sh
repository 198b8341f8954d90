#!/bin/sh
# mrpt_fastlio: checks that each test that docs/security.md names exists.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: tests/structure/check_security.sh [SOURCE_DIR]
set -eu

cd "${1:-$(dirname "$0")/../..}"
page=docs/security.md
# `Suite.Name` in the last column of the table of limits, or anywhere in the text.
named=$(grep -o '`[A-Z][A-Za-z]*\.[A-Z][A-Za-z0-9]*`' "$page" | tr -d '\140' | sort -u)
if [ -z "$named" ]; then
  echo "$page names no test"
  exit 1
fi
status=0
for test in $named; do
  if ! grep -rqE --include='*_test.cpp' "TEST(_[FP])?\(${test%.*}, ${test#*.}\)" modules apps tests; then
    echo "$page: there is no test $test"
    status=1
  fi
done
# Each row of the table of limits names one.
limits=$(sed -n '/^| input | limit/,/^$/p' "$page" | tail -n +3 | grep -c '^|' || true)
tested=$(sed -n '/^| input | limit/,/^$/p' "$page" | tail -n +3 | grep -cE '\| `[A-Za-z]+\.[A-Za-z0-9]+` \|$' || true)
if [ "$limits" -eq 0 ] || [ "$limits" -ne "$tested" ]; then
  echo "$page: $tested of $limits limits name a test"
  status=1
fi
[ "$status" -eq 0 ] && echo "Security: $(echo "$named" | wc -l) tests, $limits limits."
exit "$status"
