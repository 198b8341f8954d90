// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file room_recording.h A recording with exact truth: a LiDAR and an IMU moved by hand in a room
 * that is a box. All ranges are closed forms. */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/lidar/scan.h>

#include <cstdint>
#include <vector>

namespace fastlio::testing
{
struct RoomSettings
{
  double duration = 6.0;      //!< [s]
  double rest = 2.1;          //!< at rest from the start [s]; 0: never at rest
  double imu_rate = 200.0;    //!< [Hz]
  int columns = 180;          //!< per scan of 0.1 s, each with 16 lines
  double range_noise = 0.01;  //!< [m]
  ImuNoise noise{1e-4, 1e-3, 0.0, 0.0};
  Vec3 gyro_bias = {0.003, -0.002, 0.001};
  Vec3 accel_bias = {0.02, -0.01, 0.015};
};

/** True pose of the IMU t seconds after the start; at the origin and level until the rest ends. */
[[nodiscard]] Pose truePose(double t, double rest);

struct RoomRecording
{
  RoomSettings settings;
  std::vector<ImuSample> imu;
  std::vector<LidarScan> scans;

  [[nodiscard]] Pose truthAt(std::int64_t stamp_ns) const;
};

constexpr std::int64_t kRecordingStart = 1'700'000'000'000'000'000;

[[nodiscard]] RoomRecording recordRoom(const RoomSettings& settings = {});

/** The same room for so many seconds. */
[[nodiscard]] RoomRecording recordRoom(double duration);

/** OdometryOptions with the recording's noise. */
[[nodiscard]] OdometryOptions roomParameters(const RoomSettings& settings = {});

}  // namespace fastlio::testing
