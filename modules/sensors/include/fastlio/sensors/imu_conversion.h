// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_conversion.h CObservationIMU to ImuSample. */
#pragma once

#include <fastlio/filter/imu.h>

#include <mrpt/obs/CObservationIMU.h>

#include <optional>

namespace fastlio
{
/** Why an inertial observation cannot be used. */
enum class ImuDefect
{
  None,
  NoAcceleration,  //!< a channel IMU_X_ACC, IMU_Y_ACC or IMU_Z_ACC is absent
  NoAngularRate,   //!< a channel IMU_WX, IMU_WY or IMU_WZ is absent
  NotFinite,       //!< NaN or infinite
  NoStamp          //!< INVALID_TIMESTAMP
};

[[nodiscard]] const char* toString(ImuDefect defect);

/** The sample, or why there is none. */
struct ImuConversion
{
  std::optional<ImuSample> sample;
  ImuDefect defect = ImuDefect::None;
};

/** Takes angular rate [rad/s] and specific force [m/s^2] as they are, in the frame of the sensor.
 */
[[nodiscard]] ImuConversion toImuSample(const mrpt::obs::CObservationIMU& observation);

}  // namespace fastlio
