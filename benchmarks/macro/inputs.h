// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file inputs.h The input of the odometry in a benchmark, in memory, so that reading takes no
 * part.
 */
#pragma once

#include <fastlio/config/config.h>
#include <fastlio/filter/imu.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/lidar/scan.h>

#include <string>
#include <variant>
#include <vector>

namespace fastlio::benchmarks
{
using Input = std::variant<ImuSample, LidarScan>;

/** A recording with the parameters to run it with. */
struct Inputs
{
  std::string name;
  std::vector<Input> data;
  OdometryOptions parameters;
};

/** All usable observations of a rawlog.
 * \exception std::runtime_error it cannot be read, or has no LiDAR and IMU */
[[nodiscard]] Inputs inputsOfRecording(const std::string& rawlog, const Config& config);

/** A simulated scenario, its scans with full density, with the parameters that match its sensors.
 * \param duration [s]; 0: the scenario's own
 * \exception std::invalid_argument no such scenario */
[[nodiscard]] Inputs inputsOfScenario(const std::string& scenario, double duration);

}  // namespace fastlio::benchmarks
