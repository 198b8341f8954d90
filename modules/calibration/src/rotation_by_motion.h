// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rotation_by_motion.h How the LiDAR is turned in the IMU frame, by what both of them see of
 * the motion (internal). */
#pragma once

#include <fastlio/calibration/calibration_run.h>
#include <fastlio/math/so3.h>

#include <optional>
#include <vector>

namespace fastlio
{
/** A rotation that contradicts the given one. */
struct ShownRotation
{
  Mat3 R_imu_lidar;
  double angle = 0.0;  //!< to the given one [rad]
};

/** The rotation of the first recording whose motion tells it; nothing if there is none, or if it is
 * about the given one. It is a rough one: to degrees. */
[[nodiscard]] std::optional<ShownRotation> contradictingRotation(
    const std::vector<CalibrationRecording>& recordings, const Config& config);

}  // namespace fastlio
