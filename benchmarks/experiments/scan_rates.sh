#!/bin/sh
# mrpt_fastlio: scan rates from 5 to 100 Hz: nothing assumes 10 Hz.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/experiments/scan_rates.sh BUILD_DIR OUTPUT_DIR
. "$(dirname "$0")/library.sh"

header "scan rate"
for scenario in uav office; do
  for rate in 5 10 20 50 100; do
    variant "$scenario, $rate Hz" $scenario-${rate}hz $scenario "--scan-rate $rate"
  done
done
