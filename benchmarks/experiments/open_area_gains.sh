#!/bin/sh
# mrpt_fastlio: the paper's comparison with LINS: a sparse open area, both gains, few and many points.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/experiments/open_area_gains.sh BUILD_DIR OUTPUT_DIR
# The gain of eq. 18 can afford about 147 points, that of eq. 20 about 784: the targets of the
# downsampling are such that about as many match.
. "$(dirname "$0")/library.sh"

few="map.type=knn downsampling.target_points=175 downsampling.wide_points=0"
many="map.type=knn downsampling.target_points=920 downsampling.wide_points=0"
planes="downsampling.target_points=2050 downsampling.wide_points=0"

header "open area"
# shellcheck disable=SC2086  # several parameters
for gain in standard information; do
  [ $gain = standard ] && equation="eq. 18" || equation="eq. 20"
  variant "$equation, few points, exact neighbours" open_area open_area "" gain=$gain $few
  variant "$equation, many points, exact neighbours" open_area open_area "" gain=$gain $many
  variant "$equation, many points, map of planes" open_area open_area "" gain=$gain $planes
done
