#!/bin/sh
# mrpt_fastlio: clang-tidy over every source file of the compilation database.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: cmake/run_clang_tidy.sh BUILD_DIR [JOBS] [FILE...]     (default: all files)
set -eu
cd "$(dirname "$0")/.."
build=$1
jobs=${2:-1}
shift $(($# < 2 ? $# : 2))

# What an ordinary build does not compile has no compiler flags.
not_built='^plugins/mola_fastlio/|^tests/mola/|^benchmarks/peers/|^tests/fuzz/fuzz_[a-z]*\.cpp$'
files=$(if [ $# -gt 0 ]; then printf '%s\n' "$@"; else cmake/list_sources.sh | grep '\.cpp$'; fi |
  grep -Ev "$not_built" || true)
# Unity units hide the files that they include: a file that is not found must not pass as checked.
for file in $files; do
  grep -q "\"file\": \".*/$file\"" "$build/compile_commands.json" || {
    echo "clang-tidy: $build does not compile $file; configure it with" \
      "-DMRPT_FASTLIO_UNITY=OFF -DMRPT_FASTLIO_BENCHMARKS=ON" >&2
    exit 1
  }
done
printf '%s\n' $files |
  xargs -r -n 1 -P "$jobs" clang-tidy --quiet --extra-arg=-Wno-unknown-warning-option \
    --extra-arg=-Wno-unused-command-line-argument -p "$build" ||
  { echo "clang-tidy: see the findings above; .clang-tidy says which checks apply" >&2; exit 1; }
