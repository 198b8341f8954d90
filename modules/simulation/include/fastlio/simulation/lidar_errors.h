// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file lidar_errors.h Errors of a LiDAR that stay as they are: offsets of its lasers, bias of its
 * ranges, and a mounting that is not the one in the recording. */
#pragma once

#include <fastlio/simulation/lidar_model.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** The true errors of one LiDAR, which the configuration does not contain. */
struct LidarErrors
{
  Pose T_imu_lidar;                      //!< true mounting
  std::vector<double> range_offset;      //!< of each laser line (Shot::ring) [m]
  std::vector<double> elevation_offset;  //!< of each laser line [rad]
  std::vector<double> azimuth_offset;    //!< of each laser line, about the LiDAR's z axis [rad]
};

/** The errors of the sensor with this seed. */
[[nodiscard]] LidarErrors drawLidarErrors(const SimulationSettings& settings);

/** Where a shot really goes; LiDAR frame. Its nominal direction is what the data say. */
[[nodiscard]] Vec3 trueDirection(const Shot& shot, const LidarErrors& errors);

/** The origin of the light that came back: the surface that a range was measured to. */
struct Return
{
  double range = 0.0;         //!< [m]
  double facing = 1.0;        //!< cosine of the angle of incidence
  double reflectivity = 0.0;  //!< 0..1
};

/** Error of a range by incidence and reflectivity [m]: incidence_bias (1 - cos a) / (1 - cos 80
 * deg)
 * + dark_bias + reflectivity (bright_bias - dark_bias). */
[[nodiscard]] double rangeBias(const BeamSettings& settings, const Return& back);

/** LiDAR clock minus IMU clock, given or not, so long after the start [s]. */
[[nodiscard]] double clockOffset(const LidarSettings& settings, double seconds);
/** The stamp that the LiDAR gives to an instant. */
[[nodiscard]] std::int64_t stampOfLidar(std::int64_t stamp_ns, const SimulationSettings& settings);

}  // namespace fastlio
