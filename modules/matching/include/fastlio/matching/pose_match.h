// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file pose_match.h Where a scan is pulled to from a pose that is uncertain, while nothing else
 * is. */
#pragma once

#include <fastlio/filter/update.h>

namespace fastlio
{
/** A pose to match from. */
struct PoseStart
{
  Pose T_world_imu;
  Vec3 attitude_variance = Vec3::Zero();  //!< about the axes of the body [rad^2]
  double position_variance = 0.0;         //!< along each axis [m^2]
};

/** The pose that a scan is pulled to. */
struct PoseMatch
{
  bool updated = false;  //!< false: too few points match, or a step is not finite
  Pose T_world_imu;
  InformationSums sums;  //!< at the last iterate
};

}  // namespace fastlio
