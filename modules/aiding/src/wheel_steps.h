// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file wheel_steps.h The way from scan to scan by the wheels and by the odometry (internal). */
#pragma once

#include <fastlio/aiding/wheels.h>
#include <fastlio/run/pose_track.h>

#include <vector>

namespace fastlio
{
/** From one pose of the odometry to the next. */
struct WheelStep
{
  std::int64_t begin_ns = 0, end_ns = 0;
  bool known = false;          //!< there are readings all along
  Vec3 rolled = Vec3::Zero();  //!< way of the vehicle by the wheels; the odometry's world [m]
  double along = 0.0;          //!< the same along the vehicle [m]
  double beyond = 0.0;         //!< by how much that is more than the odometry's way [m]
  bool slipped = false;
};

/** The steps of a session, slip marked: the odometry's errors change slowly, those of wheels that
 * slip at once. */
struct WheelSteps
{
  std::vector<WheelStep> steps;
  double noise_variance = 0.0;  //!< of the wheels' way after 1 m, at most [m^2]
};

[[nodiscard]] WheelSteps wheelSteps(
    const std::vector<WheelPose>& readings, const Pose& T_vehicle_imu, const PoseTrack& track);

}  // namespace fastlio
