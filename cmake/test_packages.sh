#!/bin/sh
# mrpt_fastlio: installs the Debian packages by apt in a clean Debian 12 root and runs the programs there.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: cmake/test_packages.sh PACKAGES_DIR ROOT_DIR      needs root; ROOT_DIR is made when absent
set -eu

if [ $# -ne 2 ]; then
  sed -n '5s/^# //p' "$0" >&2
  exit 2
fi
packages=$1
mkdir -p "$2"
root=$(cd "$2" && pwd)

command -v debootstrap >/dev/null || apt-get install --yes --quiet debootstrap
[ -e "$root/etc/debian_version" ] || debootstrap --variant=minbase bookworm "$root"
cp /etc/resolv.conf "$root/etc/resolv.conf"
rm -rf "$root/srv/mrpt_fastlio"
cp -r "$packages/apt" "$root/srv/mrpt_fastlio"

chroot "$root" sh -euc '
  apt-get purge --yes --quiet mrpt-fastlio >/dev/null 2>&1 || true
  echo "deb [trusted=yes] file:/srv/mrpt_fastlio ./" >/etc/apt/sources.list.d/mrpt_fastlio.list
  apt-get update --quiet
  apt-get install --yes --quiet --no-install-recommends mrpt-fastlio libmrpt-fastlio-dev mrpt-fastlio-plugin
  cd /tmp
  fastlio-sim --scenario office --duration 8 --output-dir walk
  fastlio-replay --config walk/config.yaml --input-rawlog walk/recording.rawlog --frame imu --output-dir result
  fastlio-eval walk/ground_truth.tum result/covariance.csv --align first --max-ape 0.05
  test -e /usr/share/man/man1/fastlio-replay.1.gz || test -e /usr/share/man/man1/fastlio-replay.1
  ls /usr/lib/*/libmrpt_fastlio_plugin.so
  echo "packages: installed and run"
'
