#!/bin/sh
# mrpt_fastlio: checks lengths of files and functions, licence lines, and that each class has a name of its own.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: tests/structure/check_structure.sh [SOURCE_DIR]
set -eu

max_file_lines=300
max_function_lines=60
here=$(cd "$(dirname "$0")" && pwd)
cd "${1:-$here/../..}"
failures=$(mktemp)
trap 'rm -f "$failures"' EXIT

sources_of() {
  find modules apps plugins tests benchmarks docs -type f \( -name '*.cpp' -o -name '*.h' \) | sort
}

scripts_of() {
  find cmake tests benchmarks -type f \( -name '*.sh' -o -name '*.awk' -o -name '*.cmake' \) | sort
}

check_length() {
  lines=$(wc -l <"$1")
  [ "$lines" -le "$max_file_lines" ] ||
    echo "$1: $lines lines; at most $max_file_lines are allowed: split it by reasons to change"
}

check_licence() {
  head -n 3 "$1" | grep -q 'SPDX-License-Identifier: BSD-3-Clause' ||
    echo "$1: 'SPDX-License-Identifier: BSD-3-Clause' is missing in the first lines"
}

# Modules share a namespace, and a program may contain both of two classes of one name: then one's functions run
# on the other's objects.
check_names() {
  for program in modules apps/* plugins/*; do
    [ ! -d "$program" ] || find modules "$program" -path '*/tests' -prune -o -type f -name '*.h' -exec \
      grep -HoE '^(class|struct) [A-Za-z0-9_]+( final)?( : .*)?$' {} + |
      sed -E 's/^([^:]*):(class|struct) ([A-Za-z0-9_]+).*/\3 \1/' | sort -u |
      awk '$1 == name { print $2 ": " name " is a class of " file ", too: give one of them another name" }
           { name = $1; file = $2 }'
  done | sort -u
}

for file in $(sources_of) $(scripts_of); do
  check_length "$file"
  check_licence "$file"
done >"$failures"
check_names >>"$failures"
# shellcheck disable=SC2046  # no blanks in the names of our files
awk -v limit="$max_function_lines" -f "$here/long_functions.awk" $(sources_of) >>"$failures" || true

if [ -s "$failures" ]; then
  cat "$failures"
  exit 1
fi
echo "Structure: $(sources_of | wc -l) source files, all within the limits."
