#!/usr/bin/env bash
# mrpt_fastlio: no RUNPATH below a folder has an empty or relative element, the current directory.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: check_runpath.sh DIR
set -euo pipefail

checked=0
bad=0
while IFS= read -r -d '' file; do
  [[ $(head -c 4 "$file" | tr -d '\0') == $'\x7fELF' ]] || continue
  checked=$((checked + 1))
  runpath=$(readelf -d "$file" 2>/dev/null | sed -nE 's/.*\((RUNPATH|RPATH)\).*\[(.*)\]$/\2/p')
  [ -n "$runpath" ] || continue
  while IFS= read -r -d ':' element; do
    case "$element" in
      /* | '$ORIGIN' | '$ORIGIN'/*) ;;
      *)
        echo "$file: '$element' in its RUNPATH $runpath" >&2
        bad=$((bad + 1))
        ;;
    esac
  done < <(printf '%s:' "$runpath")
done < <(find "$1" -type f \( -perm -u+x -o -name '*.so*' \) -print0)

if [ "$checked" -eq 0 ]; then
  echo "check_runpath: no program or library in $1" >&2
  exit 1
fi
echo "check_runpath: $checked files, $bad wrong elements"
[ "$bad" -eq 0 ]
