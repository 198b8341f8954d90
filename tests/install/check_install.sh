#!/usr/bin/env bash
# mrpt_fastlio: installs the build, moves the tree, builds and runs a consumer against it.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: check_install.sh BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$1
source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "check_install: $*" >&2
  exit 1
}

cmake --install "$build" --prefix "$work/first" >"$work/install.log"
mv "$work/first" "$work/moved"
tree=$work/moved

# Neither where it was built nor where it was installed first may be in it. (The tree's own name may: it is that of the
# project.)
for path in "$build" "$source/"{modules,apps,plugins,docs,build} "$work/first"; do
  if grep -rl --fixed-strings "$path" "$tree"; then
    fail "the files above contain the path $path"
  fi
done

"$(dirname "$0")/check_runpath.sh" "$tree" || fail "RUNPATH of the installed tree"

for program in "$tree"/bin/*; do
  "$program" --version >/dev/null || fail "$program does not start from the moved tree"
done

cmake -S "$source/tests/install/consumer" -B "$work/consumer" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$tree" -DEXAMPLES="$source/docs/examples" >"$work/configure.log" ||
  { cat "$work/configure.log"; fail "the consumer does not configure"; }
cmake --build "$work/consumer" || fail "the consumer does not build"
"$work/consumer/minimal_loop" | tail -n 1 | grep tracking || fail "the consumer does not track"

# A component that does not exist is named.
if cmake -S "$source/tests/install/consumer" -B "$work/wrong" -DCMAKE_PREFIX_PATH="$tree" \
  -DEXAMPLES="$source/docs/examples" -DCOMPONENT=odometri >"$work/wrong.log" 2>&1; then
  fail "an unknown component was accepted"
fi
grep -q odometri "$work/wrong.log" || fail "the unknown component is not named"

# shellcheck disable=SC1090
completions=$tree/share/bash-completion/completions/fastlio-replay
options=$(PATH="$tree/bin:$PATH" bash -c "source $completions
  COMP_WORDS=(fastlio-replay --out); COMP_CWORD=1; _mrpt_fastlio; echo \"\${COMPREPLY[@]}\"")
[[ " $options " == *" --output-dir "* ]] || fail "completion of --out gave '$options'"
echo "installed, moved, used: ok"
