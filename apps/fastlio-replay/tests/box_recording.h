// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file box_recording.h Small recordings of a platform in a box-shaped room, for the command-line
 * tests. */
#pragma once

#include <string>

namespace fastlio::testing
{
/** The content of the recording. */
struct BoxRecording
{
  double seconds = 4.0;
  double start = 0.0;  //!< of the recording, after the common epoch [s]
  bool with_imu = true;
  bool with_lidar = true;
  bool with_accelerometer = true;
  double lidar_starts = 0.0;      //!< the LiDAR is switched on this much later [s]
  double shake_amplitude = 0.0;   //!< of the angular rate, at 3 Hz [rad/s]
  bool rotten_points = false;     //!< every seventh point NaN or zero, every tenth scan empty
  bool view_covered = false;      //!< no point is finite
  bool stamps_jump_back = false;  //!< some observations come with stamps one second old
  bool point_times = true;        //!< false: clouds have no time field
  double times_per_second = 1.0;  //!< what the time field shows for a second
  double imu_height = 0.1;        //!< above the vehicle's origin [m]
  std::string imu_label = "imu";
  std::string lidar_label = "lidar";
};

/** Writes it: IMU at 100 Hz, 16 lines x 120 columns at 10 Hz, in the order of time; gzip. */
void writeBoxRecording(const std::string& path, const BoxRecording& recording);

}  // namespace fastlio::testing
