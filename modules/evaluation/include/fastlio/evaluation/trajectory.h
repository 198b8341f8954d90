// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file trajectory.h A time-stamped sequence of poses, optionally with their covariances. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/math/pose.h>

#include <string>
#include <vector>

namespace fastlio
{
/** Poses in the order of time. Two trajectories that are compared share the clock and the body
 * frame; their world frames may differ (see Alignment). */
struct Trajectory
{
  std::string source;              //!< file or other name, for messages
  std::vector<StampedPose> poses;  //!< stamps of one clock, strictly increasing

  /** One per pose, or empty. Order (rx, ry, rz, px, py, pz): attitude error [rad] in the body
   * frame, R = R_mean Exp(dtheta); position error [m] in the world frame. */
  std::vector<Matrix6> covariances;

  [[nodiscard]] bool hasCovariances() const { return !covariances.empty(); }
};

/** Checks what the struct promises.
 * \exception std::invalid_argument empty, a non-finite pose, stamps that do not increase, or
 * another number of covariances than of poses; the message names source, index and stamp */
void requireValid(const Trajectory& trajectory);

/** Distance travelled from the first pose up to each pose [m]; as many entries as poses. */
[[nodiscard]] std::vector<double> pathLengths(const std::vector<StampedPose>& poses);

/** Angle of a rotation [rad], in [0, pi]. */
[[nodiscard]] double rotationAngle(const Mat3& R);

}  // namespace fastlio
