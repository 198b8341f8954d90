#!/bin/sh
# mrpt_fastlio: what each part of the method and each option does, one change at a time.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/experiments/ablation.sh BUILD_DIR OUTPUT_DIR
# SCENARIOS in the environment restricts the recordings.
. "$(dirname "$0")/library.sh"

# Label | parameters; a further option is one line.
variants='
default |
features: planar | features.mode=planar
features: planar and edges | features.mode=planar_and_edge
features: of wide surroundings | features.mode=planar_and_edge features.half_width=0.5
no backward propagation | lidar.deskew=false
single update | update.max_iterations=1
samples held from the left (paper) | imu.hold=left
zero velocity at every rest | rest.enabled=true
no zero velocity at the start | rest.at_start=false
no more points in wide scenes | downsampling.wide_points=0
directions without information updated, too | measurement.min_signal_to_noise=0
time offset as given | calibration.estimate_time_offset=false
extrinsic estimated | calibration.estimate_extrinsic=true
resting start without a comparison of scans | initialization.mode=rest
exact neighbours (paper) | map.type=knn
paper: features, exact neighbours, left hold | features.mode=planar_and_edge map.type=knn imu.hold=left
'

for scenario in ${SCENARIOS:-office campus uav shake spin stairs open_area crowd}; do
  echo
  header "$scenario"
  echo "$variants" | while IFS='|' read -r label parameters; do
    label=$(echo "$label" | sed 's/ *$//')
    # shellcheck disable=SC2086  # several parameters
    [ -z "$label" ] || variant "$label" "$scenario" "$scenario" "" $parameters </dev/null
  done
done
