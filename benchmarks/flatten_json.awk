# mrpt_fastlio: the values of an indented JSON document as "outer.inner value" lines.
# SPDX-License-Identifier: BSD-3-Clause
{
  match($0, /^ */)
  depth = RLENGTH / 2
  if (split($0, part, "\"") < 3) next
  key[depth] = part[2]
  value = $0
  sub(/^[^:]*: */, "", value)
  sub(/,$/, "", value)
  path = key[1]
  for (i = 2; i <= depth; ++i) path = path "." key[i]
  print path, value
}
