// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file motion_window.h How scans are treated right after a start in motion. */
#pragma once

#include <fastlio/filter/state.h>

#include <cstdint>

namespace fastlio
{
/** The scans from which a start in motion was computed. They are compensated with a velocity that
 * is not well known yet, and the map that it is measured with consists of these very scans. A start
 * at rest needs none of this: velocity and biases are known, and the map has become dense before
 * the platform moves. */
struct MotionWindow
{
  std::int64_t end_ns = 0;  //!< end of the last of these scans
  /** Until then, scans correct what the start did not know well enough: velocity and biases. */
  std::int64_t settled_ns = 0;
  /** Of the downsampling, when more than downsampling.target_points: few points make no planes. */
  int target_points = 0;
  bool trial = false;  //!< a pass that computes the start: it may begin far off, every match counts
  bool pull_in = false;  //!< its scans lie far from the map: planes are searched for longer
  /** Added to the covariance after the first scan has created the map: all scans after it share the
   * map's errors and would take them for motion and biases. */
  StateMatrix covariance_after_first_scan = StateMatrix::Zero();
  /** Added to the covariance of the scan poses from which planes are created: scans that were
   * compensated with a wrong velocity warp the map. */
  Matrix6 insertion_covariance = Matrix6::Zero();

  /** Its attitude about one axis [rad^2]. */
  [[nodiscard]] double mapAttitudeVariance() const
  {
    return insertion_covariance(kAttitude, kAttitude);
  }
};

}  // namespace fastlio
