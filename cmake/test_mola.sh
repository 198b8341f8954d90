#!/bin/sh
# mrpt_fastlio: builds MOLA from its sources, our module with it, and runs the real mola-cli (tests/mola/run_mola.sh).
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: cmake/test_mola.sh MOLA_SOURCES BUILD_DIR
#
# MOLA_SOURCES holds checkouts of github.com/MOLAorg: mola, mola_common and, for its tools (MRPT 2.11.5 and newer), mp2p_icp.
# All of it is built below BUILD_DIR; the checkouts stay as they are. MOLA is GPL-3: what is linked with it is, too.
set -eu

if [ $# -ne 2 ]; then
  sed -n '5s/^# //p' "$0" >&2
  exit 2
fi
project=$(cd "$(dirname "$0")/.." && pwd)
if [ -z "$1" ] || [ ! -d "$1/mola/mola_kernel" ] || [ ! -d "$1/mola_common" ]; then
  echo "skipped: no sources of MOLA in '$1': checkouts of github.com/MOLAorg/mola and MOLAorg/mola_common are needed there" >&2
  exit 77
fi
sources=$(cd "$1" && pwd)
mkdir -p "$2"
build=$(cd "$2" && pwd)
prefix=$build/prefix

# package NAME FOLDER
package() {
  echo "$1"
  cmake -S "$2" -B "$build/$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_INSTALL_PREFIX="$prefix" -DBUILD_TESTING=OFF >"$build/$1.log" 2>&1 &&
    cmake --build "$build/$1" --target install >>"$build/$1.log" 2>&1 ||
    { tail -n 40 "$build/$1.log"; return 1; }
}

# MOLA's snapshot of 2024-03 does not compile with MRPT 2.12 and newer, whose macros for virtual classes want the namespace:
# a copy of it gets that.
rm -rf "$build/mola"
cp -r "$sources/mola" "$build/mola"
if grep -rqs 'define DEFINE_VIRTUAL_MRPT_OBJECT(class_name, NameSpace)' /usr/include/mrpt/rtti; then
  grep -rlE 'DEFINE_VIRTUAL_(SERIALIZABLE|MRPT_OBJECT)\([A-Za-z0-9]+\)' "$build/mola" |
    xargs sed -i -E 's/DEFINE_VIRTUAL_(SERIALIZABLE|MRPT_OBJECT)\(([A-Za-z0-9]+)\)/DEFINE_VIRTUAL_\1(\2, mola)/'
fi

package mola_common "$sources/mola_common"
for name in mola_yaml mola_kernel mola_launcher mola_input_rawlog; do
  package "$name" "$build/mola/$name"
done
if [ ! -d "$sources/mp2p_icp" ]; then
  echo "mp2p_icp: no sources; its tools are not run"
elif ! pkg-config --atleast-version=2.11.5 mrpt-core 2>/dev/null && [ "$(dpkg-query --show --showformat='${Version}' libmrpt-dev |
    sed 's/^[0-9]*://; s/+.*//' | awk -F . '{ print (($1 * 1000 + $2) * 1000 + $3 >= 2011005) }')" != 1 ]; then
  echo "mp2p_icp: needs MRPT 2.11.5; its tools are not run"
else
  package mp2p_icp "$sources/mp2p_icp"
fi

echo mrpt_fastlio
cmake -S "$project" -B "$build/mrpt_fastlio" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" >"$build/mrpt_fastlio.log"
cmake --build "$build/mrpt_fastlio" --target mola_fastlio mola_fastlio_listener fastlio-replay fastlio-sim
cd "$build/mrpt_fastlio"
ctest --output-on-failure --verbose --tests-regex '^Mola\.'
