# mrpt_fastlio: reports classes with more than `limit` data members, in files formatted with .clang-format.
# SPDX-License-Identifier: BSD-3-Clause
#
# Counts every class, nested ones on their own, and those structs that have private members. A struct whose members
# are all public is a record: it holds no state that others have to keep consistent.
# Relies on the format: the braces of a class stand alone on their lines; a statement ends with ';' or a lone '}'.
# Usage: awk -v limit=16 -f data_members.awk FILE...
# With -v print_all=1, prints "members file:line name" of every class instead.

function nameOf(head) {
  sub(/^template *<.*> */, "", head)
  sub(/ +: .*/, "", head)
  sub(/ final$/, "", head)
  sub(/^(class|struct) +/, "", head)
  return head
}

# Removes what balanced pairs of brackets hold: a<b<c>> becomes a.
function without(text, opening, closing,    before) {
  do {
    before = text
    gsub(opening "[^" opening closing "]*" closing, "", text)
  } while (text != before)
  return text
}

# How many data members the statement of a class body declares.
function membersIn(statement,    declarator) {
  gsub(/"[^"]*"/, "\"\"", statement)
  gsub(/\[\[[a-z_]*\]\]/, "", statement)
  while (sub(/^ *(public|private|protected) *: */, "", statement)) {}
  sub(/^ */, "", statement)
  if (statement ~ /(^| )operator/) return 0
  if (statement ~ /^(using|typedef|friend|static|enum|class|struct|union|template|namespace)( |$)/) return 0
  gsub(/<=|>=|<<|->/, "", statement)
  statement = without(statement, "<", ">")
  statement = without(statement, "{", "}")
  # A '(' ahead of the first value or comma makes it a function.
  declarator = statement
  sub(/ = .*|,.*/, "", declarator)
  if (declarator ~ /\(/) return 0
  statement = without(statement, "\\(", "\\)")
  return gsub(/,/, ",", statement) + 1
}

function indentOf(text) { match(text, /^ */); return RLENGTH }

function enter(kind) {
  ++depth
  indents[depth] = indentOf($0)
  kinds[depth] = kind
  heads[depth] = head_line
  names[depth] = nameOf(statement)
  members[depth] = 0
  hidden[depth] = statement ~ /^(template *<.*> *)?class /
  statement = ""
}

function leave() {
  if (kinds[depth] == "type" && hidden[depth]) {
    if (print_all) printf "%d %s:%d %s\n", members[depth], FILENAME, heads[depth], names[depth]
    else if (members[depth] > limit) {
      printf "%s:%d: class %s has %d data members; at most %d are allowed: move a responsibility out\n",
        FILENAME, heads[depth], names[depth], members[depth], limit
      failed = 1
    }
  }
  --depth
  statement = ""
}

FNR == 1 { depth = 0; statement = ""; in_comment = 0 }

{
  line = $0
  sub(/^ +/, "", line)
  if (in_comment) { if (!sub(/^.*\*\//, "", line)) next; in_comment = 0 }
  gsub(/\/\*([^*]|\*+[^*\/])*\*+\//, "", line)
  sub(/\/\/.*/, "", line)
  if (sub(/\/\*.*/, "", line)) in_comment = 1
  sub(/^ +/, "", line); sub(/ +$/, "", line)
  if (line == "" || line ~ /^#/) next
}

line == "{" {
  if (statement ~ /^(template *<.*> *)?(class|struct|union) /) enter("type")
  else enter("other")
  next
}

line ~ /^\}/ {
  if (depth > 0 && indents[depth] == indentOf($0)) { leave(); next }
}

line ~ /^(public|private|protected):$/ { if (line ~ /^(private|protected)/) hidden[depth] = 1; next }

{
  if (statement == "") head_line = FNR
  statement = statement (statement == "" ? "" : " ") line
  if (statement ~ /;$/) {
    if (kinds[depth] == "type") members[depth] += membersIn(statement)
    statement = ""
  }
}

END { exit failed }
