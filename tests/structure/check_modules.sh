#!/bin/sh
# mrpt_fastlio: checks what docs/architecture.md says of the modules, against the sources.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: tests/structure/check_modules.sh [SOURCE_DIR]           check
#        tests/structure/check_modules.sh --write [SOURCE_DIR]  write the column "includes" anew
#
# Three tables of the page are read, by their headers: "| module | ... | includes |", "| property | modules |" and
# "| limit | value |". Names of modules are separated by commas; "-" is none. --write also writes the properties.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
write=
if [ "${1:-}" = --write ]; then
  write=1
  shift
fi
cd "${1:-$here/../..}"
page=docs/architecture.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# module, then the modules that it includes; one line per row of the table.
documented_modules() {
  awk -F '|' '
    /^\| *module *\|/ { on = 1; next }
    on && !/^\|/ { exit }
    on && !/^\| *-+/ { gsub(/[`,]/, "", $2); gsub(/[`,]/, " ", $(NF - 1)); sub(/^ *- *$/, "", $(NF - 1)); print $2, $(NF - 1) }
  ' "$page" | awk '{ $1 = $1; print }'
}

# limit_of NAME: the numbers in the row of that limit.
limit_of() {
  awk -F '|' -v name="$1" '
    /^\| *limit *\|/ { on = 1; next }
    on && !/^\|/ { exit }
    on { sub(/^ */, "", $2); sub(/ *$/, "", $2); if ($2 == name) { gsub(/[^0-9]+/, " ", $3); print $3 } }
  ' "$page"
}

# The other modules whose headers the module's headers and sources include, in the order of the table.
included_by() {
  find "modules/$1/include" "modules/$1/src" -type f \( -name '*.h' -o -name '*.cpp' \) \
    -exec sed -n 's,^# *include *[<"]fastlio/\([a-z]*\)/.*,\1,p' {} + 2>/dev/null | sort -u |
    awk -v module="$1" -v order="$(tr '\n' ' ' <"$work/order")" '
      $1 != module { is[$1] = 1 }
      END {
        n = split(order, modules, " ")
        for (i = 1; i <= n; ++i) if (modules[i] in is) { line = line " " modules[i]; delete is[modules[i]] }
        for (other in is) line = line " " other
        print substr(line, 2)
      }'
}

check_list() {
  [ -s "$work/order" ] || echo "$page: no table of modules"
  while read -r module; do
    [ -d "modules/$module" ] || echo "$page: module '$module' is not a folder of modules/"
  done <"$work/order"
  for folder in modules/*/; do
    module=$(basename "$folder")
    grep -qx "$module" "$work/order" || echo "modules/$module: not in the table of $page"
  done
  built=$(tr '\n' ' ' <CMakeLists.txt | sed -n 's/.*set(FASTLIO_MODULES \([^)]*\)).*/\1/p' | awk '{ $1 = $1; print }')
  listed=$(tr '\n' ' ' <"$work/order" | awk '{ $1 = $1; print }')
  [ "$built" = "$listed" ] || echo "$page: modules '$listed', but CMakeLists.txt builds '$built' in this order"
}

# check_module MODULE INCLUDES: the table against the sources, and no module that stands below.
check_module() {
  actual=$(included_by "$1")
  [ "$actual" = "$2" ] || echo "$page: '$1' includes '$2', but its sources include '$actual'"
  for other in $actual; do
    awk -v module="$1" -v other="$other" '$1 == module { exit found } $1 == other { found = 1 }' "$work/order" &&
      echo "modules/$1: includes '$other', which does not stand above it in $page"
  done
  return 0
}

# The modules whose headers or sources include one of the headers of an extended regular expression.
modules_including() {
  while read -r module; do
    found=$(find "modules/$module" -path '*/tests' -prune -o -type f -exec grep -lE "^# *include *<($1)" {} + 2>/dev/null || true)
    [ -z "$found" ] || echo "$module"
  done <"$work/order" | tr '\n' ' '
}

# Names of the rows of "| property | modules |", and the headers that give a module the property.
mrpt="MRPT classes"
mrpt_headers='mrpt/'
file="files"
file_headers='fstream|zlib|mrpt/io/|fastlio/files/'

# check_property NAME HEADERS
check_property() {
  listed=$(awk -F '|' -v name="$1" '
    /^\| *property *\|/ { on = 1; next }
    on && !/^\|/ { exit }
    on { sub(/^ */, "", $2); sub(/ *$/, "", $2); if ($2 == name) { gsub(/[`,]/, " ", $3); print $3 } }
  ' "$page" | awk '{ $1 = $1; print }')
  actual=$(modules_including "$2" | awk '{ $1 = $1; print }')
  [ "$listed" = "$actual" ] || echo "$page: '$1' are used by '$listed', but headers of them are included by '$actual'"
}

check_members() {
  limit=$(limit_of "data members of a class")
  if [ -z "$limit" ]; then
    echo "$page: no limit 'data members of a class'"
    return
  fi
  # shellcheck disable=SC2046  # no blanks in the names of our files
  awk -v limit="$((limit))" -f "$here/data_members.awk" /dev/null \
    $(find modules apps plugins -type f \( -name '*.h' -o -name '*.cpp' \) | grep -v /tests/ | sort) || true
}

# within NAME COUNT: the count against the row "least to most" of a limit.
within() {
  # shellcheck disable=SC2046  # two numbers
  set -- "$1" "$2" $(limit_of "$1")
  [ $# -eq 4 ] || { echo "$page: no limit '$1' of the form 'least to most'"; return; }
  [ "$2" -ge "$3" ] && [ "$2" -le "$4" ] || echo "$1: $2, but $page says $3 to $4${5:-}"
}

# Rows of keys ahead of the first heading that has "expert" in it.
main_keys() {
  awk 'tolower($0) ~ /^#.*expert/ { exit } /^\| *`[a-z_0-9]+\./ { ++n } END { print n + 0 }' docs/parameters.md
}

check_presets() {
  for preset in params/*.yaml; do
    within "lines of a preset" "$(wc -l <"$preset")" | sed "s,^,$preset: ,"
  done
}

write_property() {
  awk -F '|' -v OFS='|' -v name="$1" -v list="$(modules_including "$2")" '
    /^\| *property *\|/ { on = 1 }
    on && !/^\|/ { on = 0 }
    on { key = $2; sub(/^ */, "", key); sub(/ *$/, "", key)
      if (key == name) { sub(/ *$/, "", list); gsub(/ /, ", ", list); $3 = " " list " " } }
    { print }
  ' "$page" >"$work/page"
  cat "$work/page" >"$page"
}

write_includes() {
  while read -r module _; do
    [ ! -d "modules/$module" ] || echo "$module $(included_by "$module")"
  done <"$work/modules" >"$work/actual"
  awk -F '|' -v OFS='|' '
    NR == FNR { split($0, words, " "); module = words[1]; text = substr($0, length(module) + 2)
      gsub(/ +/, ", ", text); includes[module] = text == "" ? "-" : text; next }
    /^\| *module *\|/ { on = 1 }
    on && !/^\|/ { on = 0 }
    on { name = $2; gsub(/[` ]/, "", name); if (name in includes) $(NF - 1) = " " includes[name] " " }
    { print }
  ' "$work/actual" "$page" >"$work/page"
  cat "$work/page" >"$page"
  write_property "$mrpt" "$mrpt_headers"
  write_property "$file" "$file_headers"
}

documented_modules >"$work/modules"
awk '{ print $1 }' "$work/modules" >"$work/order"
if [ -n "$write" ]; then
  write_includes
  documented_modules >"$work/modules"
fi
{
  check_list
  while read -r module includes; do
    check_module "$module" "$includes"
  done <"$work/modules"
  check_property "$mrpt" "$mrpt_headers"
  check_property "$file" "$file_headers"
  check_members
  within "main keys" "$(main_keys)"
  check_presets
} >"$work/failures"

if [ -s "$work/failures" ]; then
  cat "$work/failures"
  exit 1
fi
echo "Modules: $(wc -l <"$work/order"), with the includes of $page; classes, keys and presets within its limits."
