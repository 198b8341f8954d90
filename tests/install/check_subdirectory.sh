#!/usr/bin/env bash
# mrpt_fastlio: a project that adds this one by add_subdirectory() gets its libraries, and nothing it did not ask for.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: check_subdirectory.sh SOURCE_DIR COMPILER
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "check_subdirectory: $*" >&2
  exit 1
}

mkdir "$work/parent"
cat >"$work/parent/CMakeLists.txt" <<EOF
cmake_minimum_required(VERSION 3.25)
project(parent LANGUAGES CXX)
include(CTest)
add_subdirectory($source fastlio)
add_executable(own main.cpp)
target_link_libraries(own PRIVATE mrpt_fastlio::odometry)
EOF
echo 'int main() { return 0; }' >"$work/parent/main.cpp"
configure() {
  cmake -G Ninja -S "$work/parent" -B "$1" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
    "${@:2}" >"$1.log" 2>&1 || { cat "$1.log"; fail "the project does not configure"; }
}
compiler=$2

configure "$work/default"
! grep -q -- -Werror "$work/default/compile_commands.json" || fail "warnings are errors"
grep -q 'modules/odometry' "$work/default/compile_commands.json" || fail "the libraries are missing"
! grep -qE '(/tests/|/benchmarks/|/apps/|/docs/|/plugins/)' "$work/default/compile_commands.json" ||
  fail "more than the libraries is built"
(cd "$work/default" && ctest -N) | grep -qx 'Total Tests: 0' || fail "there are tests"
cmake --install "$work/default" --prefix "$work/installed" >"$work/install.log" 2>&1 || fail "it does not install"
[ -z "$(find "$work/installed" -type f 2>/dev/null)" ] || fail "something is installed"
! grep -q '^CMAKE_BUILD_TYPE:STRING=Release' "$work/default/CMakeCache.txt" || fail "the build type is set"

# Who asks for it, gets it.
configure "$work/all" -DMRPT_FASTLIO_WERROR=ON -DMRPT_FASTLIO_TESTS=ON -DMRPT_FASTLIO_PROGRAMS=ON \
  -DMRPT_FASTLIO_INSTALL=ON
grep -q -- -Werror "$work/all/compile_commands.json" || fail "warnings are no errors"
# By the name of the target: sources may be compiled in units, whose files lie in the build tree.
for part in test_odometry fastlio-replay; do
  grep -q "/$part\.dir/" "$work/all/compile_commands.json" || fail "$part is not built"
done
echo "added to another project: ok"
