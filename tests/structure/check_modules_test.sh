#!/bin/sh
# mrpt_fastlio: checks that check_modules.sh finds what it is there to find, and nothing else.
# SPDX-License-Identifier: BSD-3-Clause
# shellcheck disable=SC2016  # backticks of Markdown are meant as they stand
set -eu

here=$(cd "$(dirname "$0")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
cd "$tree"
mkdir -p apps plugins docs params modules/low/include/fastlio/low modules/high/src modules/high/tests

fail() {
  echo "FAILED: $*"
  exit 1
}

# page LOW HIGH [MRPT]: the page with what the tables say of both modules.
page() {
  cat >docs/architecture.md <<END
| module | holds | includes |
|---|---|---|
| \`low\` | a, b | $1 |
| \`high\` | c | $2 |

| property | modules |
|---|---|
| MRPT classes | ${3:-} |
| files | |

| limit | value |
|---|--:|
| data members of a class | 3 |
| main keys | 1 to 2 |
| lines of a preset | 2 to 3 |
END
}

keys() { printf '%s\n' '# Main' '| `a.x` | number |' "$@"; }

sources() {
  echo '#include <fastlio/low/a.h>' >modules/low/include/fastlio/low/a.h
  printf '#include <fastlio/low/a.h>\n#include <fastlio/high/b.h>\n' >modules/high/src/b.cpp
  # Tests may include anything.
  echo '#include <fastlio/else/c.h>' >modules/high/tests/b_test.cpp
  printf 'set(FASTLIO_MODULES low\n  high)\n' >CMakeLists.txt
  keys '## Expert keys' '| `a.y` | number |' '| `a.z` | number |' >docs/parameters.md
  printf 'a:\n  x: 1\n' >params/one.yaml
  page - low
}

# class_of MEMBER...: a class with functions, types and these members.
class_of() {
  printf 'namespace n\n{\nenum class E\n{\n  A,\n  B\n};\n\n/** Text; of a class. */\nclass C : public B<int, int>\n{\n public:\n'
  printf '  C(int a, int b);\n  [[nodiscard]] int f() const { return a_; }\n  int g(\n      int a, int b = 0);\n'
  printf '  bool operator==(const C& other) const;\n'
  printf '  struct Record\n  {\n    int a, b, c, d, e;\n  };\n\n private:\n  using T = int;\n  static constexpr int k = 1;\n'
  printf '  %s\n' "$@"
  printf '};\n}  // namespace n\n'
}

expect_pass() { "$here/check_modules.sh" "$tree" >out || fail "$1: $(cat out)"; }

# expect_failure WHAT TEXT: exactly one line, with the text; then all is well again.
expect_failure() {
  "$here/check_modules.sh" "$tree" >out && fail "$1 was not found"
  grep -q "$2" out || fail "$1: '$2' is not in: $(cat out)"
  [ "$(wc -l <out)" -eq "${3:-1}" ] || fail "$1: more than that was found: $(cat out)"
  sources
}

sources
expect_pass "a right tree"

page - -
expect_failure "an include that the table lacks" "'high' includes '', but its sources include 'low'"
page - low
: >modules/high/src/b.cpp
expect_failure "an include that only the table has" "'high' includes 'low', but its sources include ''"
echo '#include "fastlio/high/b.h"' >>modules/low/include/fastlio/low/a.h
page high low
expect_failure "an include of a later module" "modules/low: includes 'high', which does not stand above it"
echo '#include <fastlio/else/c.h>' >>modules/high/src/b.cpp
expect_failure "an include of no module" "'high' includes 'low', but its sources include 'low else'" 2

echo '#include <mrpt/obs/CObservation.h>' >>modules/high/src/b.cpp
expect_failure "a use of MRPT that the table lacks" "'MRPT classes' are used by '', but .* by 'high'"
page - low high
expect_failure "a use of MRPT that is not there" "'MRPT classes' are used by 'high', but .* by ''"

mkdir modules/other
expect_failure "a module without a row" 'modules/other: not in the table'
rmdir modules/other
echo 'set(FASTLIO_MODULES high low)' >CMakeLists.txt
expect_failure "another order of the build" "CMakeLists.txt builds 'high low'"

class_of 'int a_ = 0, b_ = 0;' 'std::function<void(int, int)> c_{f(1, 2)};' >modules/high/src/c.h
expect_pass "a class of three members"
class_of 'int a_ = 0, b_ = 0;' 'std::map<int, T> c_;' 'double d_[2];' >modules/high/src/c.h
expect_failure "a class of four members" 'modules/high/src/c.h:10: class C has 4 data members; at most 3'
rm modules/high/src/c.h

keys '| `a.y` | number |' '| `a.z` | number |' '## Expert keys' >docs/parameters.md
expect_failure "three main keys" 'main keys: 3, but docs/architecture.md says 1 to 2'
printf 'a:\n  x: 1\n  y: 1\n  z: 1\n' >params/one.yaml
expect_failure "a preset of four lines" 'params/one.yaml: lines of a preset: 4, but'

page high - low
"$here/check_modules.sh" --write "$tree" >out || fail "writing the table: $(cat out)"
grep -q '^| `high` | c | low |$' docs/architecture.md || fail "the table that was written: $(cat docs/architecture.md)"
grep -q '^| MRPT classes |  |$' docs/architecture.md || fail "the property that was written: $(cat docs/architecture.md)"
expect_pass "the tree after all"
echo "The check of the modules finds what it should."
