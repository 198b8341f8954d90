// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_model.h An inertial sensor with all its faults. */
#pragma once

#include <fastlio/scenarios/settings.h>
#include <fastlio/simulation/imu_errors.h>
#include <fastlio/worlds/motion.h>

#include <vector>

namespace fastlio
{
/** The true biases at an instant. */
struct ImuBias
{
  Vec3 gyro = Vec3::Zero();   //!< [rad/s]
  Vec3 accel = Vec3::Zero();  //!< [m/s^2]
};

/** The samples of the sensor, in the order of time, and the truth. */
struct ImuRecording
{
  std::vector<ImuSample> samples;  //!< stamps as delivered (with jitter)
  std::vector<ImuBias> true_bias;  //!< of each sample
  std::size_t lost = 0;            //!< samples that were dropped
  ImuErrors errors;                //!< of this sensor
};

/** Samples at start, start + 1/rate, ... up to the end of the recording.
 *
 * Sample i is w(t_i) + b_w(t_i) + noise and R^T (a - g) + b_a + noise at its own true time t_i (or
 * the mean over the period before t_i, see ImuSettings::average), limited to the sensor's range and
 * rounded to its resolution. w and R^T (a - g) are distorted by the sensor's ImuErrors before.
 * White noise has the standard deviation density * sqrt(rate), and the biases walk by density *
 * sqrt(1/rate) from one sample to the next.
 *
 * \param settings with a duration that is not zero */
[[nodiscard]] ImuRecording simulateImu(const Motion& motion, const SimulationSettings& settings);

}  // namespace fastlio
