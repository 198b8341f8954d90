# mrpt_fastlio: changes or adds values in a parameter file as fastlio-sim writes it.
# SPDX-License-Identifier: BSD-3-Clause
#
# awk -v changes="group.name=value name=value" -f change_parameters.awk config.yaml
BEGIN {
  n = split(changes, list, " ")
  for (i = 1; i <= n; ++i) {
    at = index(list[i], "=")
    key = substr(list[i], 1, at - 1)
    keys[i] = key
    value[key] = substr(list[i], at + 1)
  }
}

# A key is added where its group ends.
function add_rest(group,   i, key) {
  for (i = 1; i <= n; ++i) {
    key = keys[i]
    if (!(key in value) || index(key, group ".") != 1) continue
    print "  " substr(key, length(group) + 2) ": " value[key]
    delete value[key]
  }
}

/^[a-zA-Z]/ {
  if (group != "") add_rest(group)
  group = $1
  sub(/:.*/, "", group)
}
/^ *[a-zA-Z_0-9]+:/ {
  name = $1
  sub(/:.*/, "", name)
  key = /^ / ? group "." name : name
  if (key in value) {
    match($0, /^ *[a-zA-Z_0-9]+:/)
    $0 = substr($0, 1, RLENGTH) " " value[key]
    delete value[key]
  }
}
{ print }
END {
  if (group != "") add_rest(group)
  for (i = 1; i <= n; ++i) {
    key = keys[i]
    if (!(key in value)) continue
    dot = index(key, ".")
    if (dot == 0) {
      print key ": " value[key]
      delete value[key]
    } else {
      print substr(key, 1, dot - 1) ":"
      add_rest(substr(key, 1, dot - 1))
    }
  }
}
