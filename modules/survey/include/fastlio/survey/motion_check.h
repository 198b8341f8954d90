// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file motion_check.h Do LiDAR and IMU see the same motion? Time offset, rotation between
 * them and unit of the gyro from the rotations that both see. */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/lidar/scan.h>
#include <fastlio/math/so3.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace fastlio
{
/** How the LiDAR turned between two scans. */
struct ScanTurn
{
  std::int64_t begin_ns = 0, end_ns = 0;  //!< middle of the earlier and of the later scan
  Vec3 rotation = Vec3::Zero();           //!< LiDAR axes [rad]
};

/** The agreement of both sensors. */
struct MotionCheck
{
  std::size_t turns = 0;   //!< pairs of scans that were used
  double correlation = 0;  //!< 0..1, at the best offset
  double time_offset = 0;  //!< added to the LiDAR's stamps it brings them to the IMU's clock [s]
  double time_offset_std = 0;  //!< of it, with what unsteady turning costs [s]
  double scale = 0;            //!< rate of the IMU over rate of the LiDAR: 1, or 57.3 for deg/s
  Mat3 R_imu_lidar = Mat3::Identity();  //!< LiDAR axes to IMU axes
  bool conclusive = false;              //!< the time offset is certain to some milliseconds
  double rotation_std = 0;              //!< of R_imu_lidar, about its least known axis [rad]
  bool rotation_known = false;          //!< R_imu_lidar is certain to a few degrees
};

/** Rotation from one scan to the next by matching points with planes; nothing when there is too
 * little to match. Points are taken as they are: compensate motion within the scans before.
 * \param guess rotation and translation of the pair before, later scan's frame to the earlier's */
[[nodiscard]] std::optional<Pose> matchScans(
    const PointColumns& earlier, const PointColumns& later, const Pose& guess = {});

/** \param samples of the IMU, ascending stamps, in any unit
 * \param range the largest offset that is looked for [s] */
[[nodiscard]] MotionCheck checkMotion(
    const std::vector<ScanTurn>& turns, const std::vector<ImuSample>& samples, double range = 0.5);

}  // namespace fastlio
