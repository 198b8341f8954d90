#!/bin/sh
# mrpt_fastlio: the paper's experiment with large rotation indoors: 830 and 1120 deg/s.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/experiments/large_rotation.sh BUILD_DIR OUTPUT_DIR
. "$(dirname "$0")/library.sh"

header "large rotation"
for scenario in shake spin; do
  variant "$scenario" $scenario $scenario ""
  variant "$scenario, features" $scenario $scenario "" features.mode=planar_and_edge
  variant "$scenario, without backward propagation" $scenario $scenario "" lidar.deskew=false
done
