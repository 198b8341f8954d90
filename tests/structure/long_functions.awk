# mrpt_fastlio: reports functions that are longer than `limit` lines, in files formatted with .clang-format.
# SPDX-License-Identifier: BSD-3-Clause
#
# Relies on the format: a function's braces stand alone on their lines, at equal indentation.
# Usage: awk -v limit=60 -f long_functions.awk FILE...

function indentOf(line) { match(line, /^ */); return RLENGTH }

# The text before an opening brace says what it opens; only functions and blocks of statements count.
function opensType(statement) {
  sub(/^ *template *<.*> +/, "", statement)
  return statement ~ /^ *(namespace|class|struct|enum|union|extern)( |$)/
}

FNR == 1 { depth = 0; statement = "" }

/^ *\{$/ {
  if (statement !~ /^ *namespace( |$)/) {
    ++depth
    indent[depth] = indentOf($0)
    first[depth] = FNR
    is_type[depth] = opensType(statement)
  }
  statement = ""
  next
}

/^ *\}/ {
  if (depth > 0 && indent[depth] == indentOf($0)) {
    lines = FNR - first[depth] + 1
    if (!is_type[depth] && lines > limit) {
      printf "%s:%d: a function of %d lines; at most %d are allowed\n", FILENAME, first[depth], lines, limit
      failed = 1
    }
    --depth
  }
  statement = ""
  next
}

/[;:]$/ || /^ *(\/\/|\/?\*|#)/ || /^ *$/ { statement = ""; next }

{ statement = statement (statement == "" ? "" : " ") $0 }

END { exit failed }
