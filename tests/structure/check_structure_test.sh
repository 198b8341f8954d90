#!/bin/sh
# mrpt_fastlio: checks that check_structure.sh finds what it is there to find, and nothing else.
# SPDX-License-Identifier: BSD-3-Clause
set -eu

here=$(cd "$(dirname "$0")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree/modules" "$tree/apps" "$tree/plugins" "$tree/tests" "$tree/benchmarks" "$tree/docs" \
  "$tree/cmake" "$tree/.ci"

fail() {
  echo "FAILED: $*"
  exit 1
}

licence() { printf '// mrpt_fastlio\n// SPDX-License-Identifier: BSD-3-Clause\n'; }

# repeat COUNT TEXT
repeat() { awk -v n="$1" -v text="$2" 'BEGIN { for (i = 0; i < n; ++i) print text }'; }

# function_of LINES: a function in a namespace and a class, with a nested block and an initialiser list.
function_of() {
  printf 'namespace n\n{\nclass C\n{\n  int f(\n      int a)\n  {\n    if (a)\n    {\n'
  repeat $(($1 - 7)) '      ++a;'
  printf '    }\n    return {\n    };\n  }\n'
  repeat 70 '  int member;'
  printf '};\n\nconst T kTable = {\n    1,\n};\n}  // namespace n\n'
}

expect_pass() { "$here/check_structure.sh" "$tree" >"$tree/out" || fail "$1: $(cat "$tree/out")"; }

expect_failure() {
  "$here/check_structure.sh" "$tree" >"$tree/out" && fail "$1 was not found"
  grep -q "$2" "$tree/out" || fail "$1: '$2' is not in: $(cat "$tree/out")"
}

{ licence; function_of 60; } >"$tree/modules/good.cpp"
expect_pass "a function of 60 lines"
{ licence; function_of 61; } >"$tree/apps/long.cpp"
expect_failure "a function of 61 lines" 'apps/long.cpp:9: a function of 61 lines'
rm "$tree/apps/long.cpp"

{ licence; repeat 299 '// text'; } >"$tree/tests/long.h"
expect_failure "a file of 301 lines" 'tests/long.h: 301 lines'
rm "$tree/tests/long.h"

echo 'int x;' >"$tree/plugins/bare.cpp"
expect_failure "a missing licence" 'plugins/bare.cpp: .SPDX'
rm "$tree/plugins/bare.cpp"
mkdir -p "$tree/modules/a/src" "$tree/modules/b/include" "$tree/modules/b/tests"
{ licence; printf 'class Twin final : public Base\n{\n};\nclass Other;\n'; } >"$tree/modules/a/src/twin.h"
{ licence; printf 'class Other\n{\n};\n'; } >"$tree/modules/b/include/other.h"
cp "$tree/modules/a/src/twin.h" "$tree/modules/b/tests/twin.h"
expect_pass "a class, its declaration elsewhere, and one of a test"
{ licence; printf 'struct Twin\n{\n};\n'; } >"$tree/modules/b/include/twin.h"
expect_failure "two classes of one name" 'b/include/twin.h: Twin is a class of modules/a/src/twin.h'
rm -r "$tree/modules/a" "$tree/modules/b"
expect_pass "the tree after all"
echo "The structure check finds what it should."
