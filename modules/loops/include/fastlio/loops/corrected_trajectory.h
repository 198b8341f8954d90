// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file corrected_trajectory.h The poses of a run after its submaps have moved. */
#pragma once

#include <fastlio/interface/scan_result.h>
#include <fastlio/loops/mapper.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace fastlio
{
/** What a wrong extrinsic makes of the pose of the IMU, relative to the first pose: scans measure
 * the motion L of the LiDAR, and with T_imu_lidar = Exp(eta) X the motion of the IMU comes out as
 * Exp(eta) A Exp(-eta) instead of A = X L X^-1. No closure shows it, because it is the same for all
 * ways to a pose.
 * \param first pose of the IMU in the world
 * \param moment of eta, a part of ScanResult::calibration_moment \return (attitude in the body frame, position in the
 * world frame) */
[[nodiscard]] Matrix6 extrinsicCovariance(
    const Pose& first, const Pose& T_world_imu, const Matrix6& moment);

/** The same where the first pose is that of another rig, whose extrinsic has an error of its own:
 * the motion from there comes out as Exp(eta_first) A Exp(-eta), and nothing cancels.
 * \param moment_of_first of eta_first \param moment of eta */
[[nodiscard]] Matrix6 extrinsicCovariance(
    const Pose& first, const Matrix6& moment_of_first, const Pose& T_world_imu,
    const Matrix6& moment);

/** Carries the correction of the submaps to every scan between them: the motion since the submap
 * before and the motion to the one after are those of the odometry; where they disagree about a
 * pose, it moves from the one to the other with the time. */
class CorrectedTrajectory
{
 public:
  /** \param session whose poses are corrected */
  CorrectedTrajectory(const MappingResult& result, std::size_t session);

  /** The scan with its corrected state and covariance; the result as it is where nothing was
   * corrected, or where it has no pose. */
  [[nodiscard]] ScanResult corrected(const ScanResult& result) const;

  /** T_corrected_odometry at a scan: takes points of the odometry's world to the corrected one. */
  [[nodiscard]] Pose correctionAt(std::int64_t stamp_ns, const Pose& T_world_imu) const;

  /** MappingResult::moves(). */
  [[nodiscard]] bool changes() const { return changes_; }

 private:
  struct Node
  {
    TrackedPose odometry;
    Pose corrected;
    Matrix6 covariance;
  };
  struct Place
  {
    const Node* before;
    const Node* after;  //!< null: behind the last
    double fraction;
  };
  [[nodiscard]] Place placeOf(std::int64_t stamp_ns) const;
  [[nodiscard]] Pose poseAt(const Place& place, const Pose& T_world_imu) const;
  [[nodiscard]] Matrix6 byExtrinsic(const Pose& T_world_imu) const;

  std::vector<Node> nodes_;
  Pose first_;
  Matrix6 extrinsic_moment_ = Matrix6::Zero();
  std::optional<Matrix6> moment_of_first_;  //!< where another rig has made the first pose
  bool changes_ = false;
};

}  // namespace fastlio
