#!/bin/sh
# mrpt_fastlio: installs the Debian packages that the build needs, when they are missing.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: cmake/install_dependencies.sh [build] [test] [browser] [conformance] [lint] [benchmark] [peers] [instructions] [mola] [packages] [fuzz]
# (default: build)
set -eu

build_packages="g++ cmake ninja-build
  libmrpt-maps-dev libmrpt-slam-dev libmrpt-topography-dev libeigen3-dev libnanoflann-dev robin-map-dev
  libcli11-dev nlohmann-json3-dev libre2-dev libyaml-dev libboost-dev libgtest-dev
  zlib1g-dev libbz2-dev liblz4-dev libzstd-dev libsqlite3-dev libpcap-dev libproj-dev"
# Inflates rawlogs 2.5 times as fast as zlib and compresses ten times as fast; zlib does both where Debian has none.
if [ "$(dpkg --print-architecture 2>/dev/null)" = amd64 ]; then
  build_packages="$build_packages libisal-dev"
fi
benchmark_packages="libbenchmark-dev"
# What the peers of benchmarks/peers.sh are built with.
peers_packages="libtbb-dev robin-map-dev libyaml-cpp-dev"
# MRPT's own programs, which the tests run on our outputs; fastlio-eval makes PNGs by librsvg's; GNU parallel starts
# workers of fastlio-tune; the benchmarks are tested, too.
test_packages="mrpt-apps librsvg2-bin parallel $benchmark_packages"
# Other writers of recordings, whose files the tests of the import read where they are installed; Slurm and ssh, which start
# workers of fastlio-tune.
conformance_packages="python3-rosbag python3-sensor-msgs lz4 zstd slurm-wlm openssh-client openssh-server"
# Shows report.html to its tests.
browser_packages="chromium"
lint_packages="clang-format clang-tidy"
instructions_packages="valgrind"
mola_packages="libmrpt-dev libtbb-dev"
packages_packages="help2man dpkg-dev file"
fuzz_packages="clang libclang-rt-dev"

is_installed() {
  [ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

missing_of() {
  for package in "$@"; do
    is_installed "$package" || printf '%s ' "$package"
  done
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "Missing packages, and neither root nor sudo to install them. As root, run:" >&2
    echo "  $*" >&2
    exit 1
  fi
}

wanted=""
for set in "${@:-build}"; do
  case "$set" in
    build) wanted="$wanted $build_packages" ;;
    test) wanted="$wanted $test_packages" ;;
    browser) wanted="$wanted $browser_packages" ;;
    conformance) wanted="$wanted $conformance_packages" ;;
    lint) wanted="$wanted $lint_packages" ;;
    benchmark) wanted="$wanted $benchmark_packages" ;;
    peers) wanted="$wanted $peers_packages" ;;
    mola) wanted="$wanted $mola_packages" ;;
    instructions) wanted="$wanted $instructions_packages" ;;
    packages) wanted="$wanted $packages_packages" ;;
    fuzz) wanted="$wanted $fuzz_packages" ;;
    *)
      echo "install_dependencies.sh: unknown set '$set'; known: build, test, browser, conformance, lint, benchmark, peers, instructions, mola, packages, fuzz" >&2
      exit 2
      ;;
  esac
done

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "Not a Debian system: please see to these packages (Debian names) yourself:" >&2
  echo "$wanted" >&2
  exit 0
fi

# shellcheck disable=SC2086  # lists of words
missing=$(missing_of $wanted)
if [ -n "$missing" ]; then
  echo "Installing: $missing"
  as_root apt-get update --quiet
  # shellcheck disable=SC2086
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --quiet --no-install-recommends $missing </dev/null
fi
