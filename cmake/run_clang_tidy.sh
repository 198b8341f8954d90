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

files=$(if [ $# -gt 0 ]; then printf '%s\n' "$@"; else cmake/list_sources.sh | grep '\.cpp$'; fi)
# Only what is built has compiler flags.
for file in $files; do
  grep -q "\"file\": \".*/$file\"" "$build/compile_commands.json" && echo "$file"
done | xargs -r -n 1 -P "$jobs" clang-tidy --quiet --extra-arg=-Wno-unknown-warning-option -p "$build" ||
  { echo "clang-tidy: see the findings above; .clang-tidy says which checks apply" >&2; exit 1; }
