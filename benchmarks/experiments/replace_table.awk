# mrpt_fastlio: replaces what stands between <!-- begin NAME --> and <!-- end NAME --> by a file.
# SPDX-License-Identifier: BSD-3-Clause
#
# awk -v name=NAME -v table=FILE -f replace_table.awk document.md
$0 == "<!-- begin " name " -->" {
  print
  while ((getline line < table) > 0) print line
  inside = found = 1
}
$0 == "<!-- end " name " -->" { inside = 0 }
!inside { print }
END {
  if (!found) {
    print FILENAME " has no line <!-- begin " name " -->" > "/dev/stderr"
    exit 1
  }
}
