#!/bin/sh
# mrpt_fastlio: makes a folder of Debian packages that apt reads as a repository, without signatures.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: cmake/apt_folder.sh PACKAGES_DIR      fills PACKAGES_DIR/apt with the packages of PACKAGES_DIR and their index
set -eu

if [ $# -ne 1 ]; then
  sed -n '4s/^# //p' "$0" >&2
  exit 2
fi
cd "$1"
rm -rf apt
mkdir apt
cp -- *.deb apt/
cd apt
dpkg-scanpackages --multiversion . >Packages
gzip --keep --no-name --best Packages
echo "Packages: $PWD"
echo "Install:  sudo apt install $PWD/mrpt-fastlio_*.deb"
