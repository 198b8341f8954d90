#!/bin/bash
# mrpt_fastlio: runs the commands of a page of the documentation, line by line.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: run_documentation.sh PAGE.md BUILD_DIR WORK_DIR INI_DIR [SANITIZER_RUNTIME]
# Lines in ```sh blocks are commands. Exit status 77: a program of MRPT is not installed.
set -u

page=$(realpath "$1"); build=$(realpath "$2"); work="$3"; export INI; INI=$(realpath "$4"); runtime="${5:-}"

for program in icp-slam rbpf-slam observations2map graph-slam rawlog-edit; do
  if ! command -v "$program" >/dev/null; then
    echo "*** NOT TESTED: '$program' is not installed (Debian: apt-get install mrpt-apps)" >&2
    exit 77
  fi
done

export PATH="$build/apps/fastlio-sim:$build/apps/fastlio-replay:$PATH"
export LD_LIBRARY_PATH="$build/lib:${LD_LIBRARY_PATH:-}"
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1

# A program that is built without a sanitizer can load the plugin that is built with one after the sanitizer's runtime
# only. What leaks in such a program is not ours.
can_load_the_plugin() {
  local line="$1"
  if [[ -n "$runtime" && "$line" == *libmrpt_fastlio_plugin.so* ]]; then
    case "$line" in
      LD_PRELOAD=*) line="LD_PRELOAD=$runtime:${line#LD_PRELOAD=}" ;;
      *) line="LD_PRELOAD=$runtime $line" ;;
    esac
    line="ASAN_OPTIONS=detect_leaks=0 $line"
  fi
  echo "$line"
}

commands=0
while IFS= read -r line; do
  [ -n "$line" ] || continue
  echo "+ $line"
  if ! bash -c "$(can_load_the_plugin "$line")" </dev/null >log.txt 2>&1; then
    tail -40 log.txt
    echo "FAILED: $line" >&2
    exit 1
  fi
  commands=$((commands + 1))
done < <(awk '/^```sh$/ { on = 1; next } /^```/ { on = 0 } on' "$page")

for file in planar.rawlog optimised.graph rooms_mrpt__maps__CSimplePointsMap_00.txt \
  planes_fastlio__CVoxelPlanesMap_00.metricmap icp-slam-log/_finalmap_.simplemap \
  rbpf-slam-log/_finalmap_.simplemap again/trajectory.tum grown/map.ply; do
  [ -s "$file" ] || { echo "FAILED: no $file" >&2; exit 1; }
done
echo "$commands commands"
[ "$commands" -ge 12 ]
