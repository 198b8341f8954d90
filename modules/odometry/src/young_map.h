// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file young_map.h How scans are treated while the map consists of the first few of them. */
#pragma once

#include <fastlio/filter/state.h>

#include <cstdint>

namespace fastlio
{
/** A start in motion has a map of one scan to measure its motion with; at rest none of this
 * matters, as velocity and biases are known and the map has become dense before it is needed. */
struct YoungMap
{
  bool in_motion = false;  //!< what the start was found in
  /** Added to the covariance when the first scan has founded the map: all scans after it share the
   * map's errors and would take them for motion and biases. */
  StateMatrix open_after_first_scan = StateMatrix::Zero();
  /** Of the downsampling, when more than downsampling.target_points: few points make no planes. */
  int target_points = 0;
  /** Of the poses with which these scans found planes, beyond what the filter tells: scans that
   * were compensated with a velocity not yet well known warp the map. */
  Matrix6 founding_covariance = Matrix6::Zero();
  std::int64_t until_ns = 0;  //!< the young map ends with the last scan that ends by then
};

}  // namespace fastlio
