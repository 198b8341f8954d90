// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// How far scans and inertial data may disagree before the calibration counts as wrong.

#include <fastlio/health/classify.h>
#include <fastlio/math/angles.h>

#include <algorithm>

namespace fastlio
{
double maxMountingError(const CalibrationOptions& options)
{
  return std::max(kRadPerDeg, 3.0 * options.extrinsic_rotation_std);
}

double maxGyroScaleError(const CalibrationOptions& options)
{
  constexpr double kOfNoCommonGyro = 0.02;
  return std::max(kOfNoCommonGyro, 3.0 * options.imu_scale_std);
}

double maxRangeScaleError(const CalibrationOptions& options)
{
  // An extrinsic that is off by a centimetre, and clocks by milliseconds, make that.
  constexpr double kOfNoCommonSensors = 0.03;
  return std::max(kOfNoCommonSensors, 3.0 * options.imu_scale_std);
}

}  // namespace fastlio
