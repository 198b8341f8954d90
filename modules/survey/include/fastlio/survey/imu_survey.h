// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_survey.h Inertial samples at rest: units, noise, the direction up. */
#pragma once

#include <fastlio/filter/imu.h>

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** The longest time at rest; numbers in the units of the recording unless said otherwise. */
struct ImuSurvey
{
  bool rests = false;                  //!< the platform rests for a second or more
  std::int64_t rest_begin_ns = 0;      //!< stamp where the longest rest begins
  double rest_seconds = 0;             //!< its length [s]
  double accel_norm = 0;               //!< magnitude of the mean specific force at rest
  Vec3 up = Vec3::Zero();              //!< its direction: the IMU's axes, unit vector
  Vec3 gyro_mean = Vec3::Zero();       //!< at rest: the bias
  double accel_noise_density = 0;      //!< at rest, per axis [unit/sqrt(Hz)]
  double gyro_noise_density = 0;       //!< at rest, per axis [unit/sqrt(Hz)]
  double accel_max = 0, gyro_max = 0;  //!< largest magnitudes of the recording
  std::string accel_unit;              //!< "m/s^2", "g", "mg"; empty: unclear
};

/** \param samples as recorded, of ascending stamps
 * \param rate [Hz] */
[[nodiscard]] ImuSurvey surveyImu(const std::vector<ImuSample>& samples, double rate);

}  // namespace fastlio
