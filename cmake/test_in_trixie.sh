#!/bin/sh
# mrpt_fastlio: builds and tests the committed state in a Debian 13 root (MRPT 2.14), as `make test` there.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: cmake/test_in_trixie.sh ROOT_DIR [MOLA_SOURCES]      needs root; debootstrap makes ROOT_DIR when absent
# With MOLA_SOURCES: as `make test-mola MOLA_SOURCES=...` there.
set -eu

if [ $# -lt 1 ] || [ $# -gt 2 ]; then
  sed -n '5s/^# //p' "$0" >&2
  exit 2
fi
if [ "$(id -u)" -ne 0 ]; then
  echo "$0: needs root, for debootstrap and chroot" >&2
  exit 1
fi
mkdir -p "$1"
root=$(cd "$1" && pwd)
source=$(cd "$(dirname "$0")/.." && pwd)

command -v debootstrap >/dev/null || apt-get install --yes --quiet debootstrap
[ -e "$root/etc/debian_version" ] || debootstrap --variant=minbase trixie "$root"

mounted() { mountpoint --quiet "$1"; }
mounted "$root/proc" || mount -t proc proc "$root/proc"
trap 'umount "$root/proc"' EXIT
cp /etc/resolv.conf "$root/etc/resolv.conf"

# Nothing of an earlier state stays but what was built.
mkdir -p "$root/mrpt_fastlio"
find "$root/mrpt_fastlio" -mindepth 1 -maxdepth 1 ! -name build -exec rm -r {} +
git -C "$source" archive HEAD | tar -x -C "$root/mrpt_fastlio"
if [ $# -eq 2 ]; then
  rm -rf "$root/mola_sources"
  cp -r "$2" "$root/mola_sources"
  target='test-mola MOLA_SOURCES=/mola_sources'
fi
chroot "$root" sh -c "apt-get install --yes --quiet make git && cd /mrpt_fastlio && make ${target:-test}"
