// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file pose_output.h The pose in files: of which body, with which covariance. */
#pragma once

#include <fastlio/interface/scan_result.h>

#include <string>

namespace fastlio
{
/** The body whose pose is exported. */
struct OutputFrame
{
  std::string name = "imu";  //!< "vehicle" or "imu"
  Pose T_imu_body;           //!< body frame to IMU frame; identity for the IMU itself
};

/** Pose and covariance of the body in the world at a scan's end. */
struct PoseEstimate
{
  Pose T_world_body;
  Matrix6 covariance;  //!< (attitude in the body frame [rad], position in the world frame [m])
};

/** True for scans whose pose belongs into a trajectory: initialised and not diverged. */
[[nodiscard]] bool hasPose(ScanStatus status);

/** \param name "vehicle" or "imu" */
[[nodiscard]] OutputFrame outputFrameOf(const std::string& name, const Pose& T_vehicle_imu);

/** T_world_body = T_world_imu T_imu_body, with the covariance carried over to first order:
 * dtheta_body = R_imu_body^T dtheta_imu, dp_body = dp_imu - R_world_imu [p_imu_body]x dtheta_imu.
 */
[[nodiscard]] PoseEstimate poseEstimateOf(const FilterState& filter, const Pose& T_imu_body);

/** The same for a pose covariance of the IMU body (attitude in the IMU frame, position in the
 * world frame). */
[[nodiscard]] PoseEstimate poseEstimateOf(
    const Pose& T_world_imu, const Matrix6& imu_covariance, const Pose& T_imu_body);

/** ",v,...": the upper triangle row by row (covarianceColumns() names it), in the shortest text
 * that reads back. */
[[nodiscard]] std::string covarianceText(const Matrix6& covariance);

/** "x,y,z,qx,qy,qz,qw" with the given separator: position with 6 decimals [m], unit quaternion with
 * 9 decimals and qw >= 0. */
[[nodiscard]] std::string poseColumns(const Pose& pose, char separator);

}  // namespace fastlio
