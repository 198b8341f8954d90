#!/bin/sh
# mrpt_fastlio: checks that check_security.sh finds what it is there to find, and nothing else.
# SPDX-License-Identifier: BSD-3-Clause
# shellcheck disable=SC2016  # backticks of Markdown are meant as they stand
set -eu

here=$(cd "$(dirname "$0")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
cd "$tree"
mkdir -p apps docs modules/low/tests tests
echo 'TEST_F(Limits, AreKept)' >modules/low/tests/low_test.cpp

page() {
  printf '%s\n' '| input | limit | beyond it | test |' '|---|---|---|---|' "$@" '' >docs/security.md
}

expect() {
  wanted=$1
  shift
  if "$here/check_security.sh" "$tree" >log; then seen=ok; else seen=bad; fi
  [ "$seen" = "$wanted" ] || { echo "FAILED: $*"; cat log; exit 1; }
}

page '| a | 1 | refused | `Limits.AreKept` |'
expect ok "a page whose test exists"
page '| a | 1 | refused | `Limits.AreLost` |'
expect bad "a test that does not exist"
page '| a | 1 | refused | `Limits.AreKept` |' '| b | 2 | refused | |'
expect bad "a limit without a test"
page
expect bad "no limits at all"
echo "check_security.sh: all as expected."
