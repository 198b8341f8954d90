#!/bin/bash
# mrpt_fastlio: holds the options of the programs against those that the pages name, both ways.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: check_options.sh SOURCE_DIR PROGRAMS_DIR
set -euo pipefail

cd "$1"; programs=$2
declare -A page_of=(
  [replay]=docs/fastlio-replay.md [info]=docs/fastlio-info.md [eval]=docs/evaluation.md [map]=docs/mapping.md
  [calibrate]=docs/calibration.md [tune]=docs/tuning.md [import]=docs/import.md [sim]=docs/simulation.md)
# Of cmake, ctest, GoogleTest, git, apt, colcon, MRPT's programs and scripts of this repository.
others='write|info|keep-label|levmarq|no-span|install|prefix|preset|build|target|output-on-failure|gtest_filter|benchmark_filter|tags|no-install-recommends|sshlogin|packages-select'

options_in() { grep -oE -- '(^|[^-A-Za-z0-9])--[a-z][a-z_-]+' | grep -oE -- '--[a-z][a-z_-]+' | sort -u; }

failures=0
known=$(mktemp); trap 'rm -f "$known"' EXIT
for program in "${!page_of[@]}"; do
  page=${page_of[$program]}
  # The first column: what is said about an option may name another program's.
  options=$("$programs/fastlio-$program" --help | grep -E '^ +(-[a-zA-Z],)?--' | options_in)
  echo "$options" >>"$known"
  for option in $options; do
    case $option in --help|--version) continue ;; esac
    grep -qE -- "(^|[^-A-Za-z0-9])$option([^a-z_-]|$)" "$page" ||
      { echo "FAILED: $page does not mention $option of fastlio-$program"; failures=$((failures + 1)); }
  done
done
for page in README.md CONTRIBUTING.md docs/*.md; do
  for option in $(options_in <"$page"); do
    grep -qx -- "$option" "$known" || grep -qxE -- "--($others)" <<<"$option" ||
      { echo "FAILED: $page: no program has $option"; failures=$((failures + 1)); }
  done
done
echo "$(sort -u "$known" | wc -l) options"
[ "$failures" -eq 0 ]
