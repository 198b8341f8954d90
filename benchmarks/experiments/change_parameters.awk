# mrpt_fastlio: changes values in a parameter file as fastlio-sim writes it.
# SPDX-License-Identifier: BSD-3-Clause
#
# awk -v changes="group.name=value name=value" -f change_parameters.awk config.yaml
BEGIN {
  n = split(changes, list, " ")
  for (i = 1; i <= n; ++i) {
    at = index(list[i], "=")
    value[substr(list[i], 1, at - 1)] = substr(list[i], at + 1)
  }
}
/^[a-z]/ { group = $1; sub(/:.*/, "", group) }
/^ *[a-zA-Z_]+:/ {
  name = $1
  sub(/:.*/, "", name)
  key = /^ / ? group "." name : name
  if (key in value) {
    match($0, /^ *[a-zA-Z_]+:/)
    $0 = substr($0, 1, RLENGTH) " " value[key]
    delete value[key]
  }
}
{ print }
END {
  for (key in value) {
    print "There is no parameter " key " in " FILENAME > "/dev/stderr"
    exit 1
  }
}
