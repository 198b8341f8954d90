// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file pose_track.h The poses of a run with their covariances: at any instant, and from one to
 * the other. */
#pragma once

#include <fastlio/interface/scan_result.h>
#include <fastlio/run/pose_output.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace fastlio
{
/** A pose of the body in the world. Covariances: attitude error in the body frame [rad], position
 * error in the world frame [m]. */
struct TrackedPose
{
  std::int64_t stamp_ns = 0;
  Pose T_world_body;
  Matrix6 covariance = Matrix6::Zero();
  Matrix6 map_covariance = Matrix6::Zero();  //!< part of the covariance that neighbours share
  /** Part of map_covariance, see ScanResult. */
  Matrix6 ambiguity_covariance = Matrix6::Zero();
  PoseByBeams pose_by_beams = PoseByBeams::Zero();  //!< see ScanResult
  Vec3 velocity = Vec3::Zero();                     //!< of the body's origin, body frame [m/s]
  Vec3 angular_velocity = Vec3::Zero();             //!< body frame [rad/s]
};

/** The motion from one pose to a later one. Covariance: attitude error in the frame of the latter,
 * position error in the frame of the former. */
struct RelativePose
{
  Pose T_a_b;
  Matrix6 covariance = Matrix6::Zero();
};

/** From b to a. */
[[nodiscard]] RelativePose reversed(const RelativePose& motion);

/** From \a a to \a b. The filter gives the covariance of each pose, not what they have in common;
 * so this is an upper bound: errors of the poses' own count as independent, and of the map's part,
 * which is nearly the same for both, only what it changed by counts. An ambiguity that appears
 * between them counts as well as the drift that the same jump corrects. What errors of the beams do
 * is known for both. */
[[nodiscard]] RelativePose relativePose(const TrackedPose& a, const TrackedPose& b);

/** The part of relativePose() that errors of the beams make: how the motion's errors follow from
 * them. */
using MotionByBeams = Eigen::Matrix<double, 6, kBeamErrors, Eigen::DontAlign>;
[[nodiscard]] MotionByBeams motionByBeams(const TrackedPose& a, const TrackedPose& b);
/** The same for errors of the calibration; relativePose() does not contain that part. */
using MotionByCalibration = Eigen::Matrix<double, 6, kCalibrationErrors, Eigen::DontAlign>;
[[nodiscard]] MotionByCalibration motionByCalibration(
    const PoseByCalibrationErrors& errors_a, const Pose& a, const PoseByCalibrationErrors& errors_b,
    const Pose& b);

/** The errors of a pose as those of the pose of another body, which the same motions of the world
 * make. */
[[nodiscard]] PoseByBeams ofOtherBody(
    const PoseByBeams& by_beams, const Pose& T_world_body, const Pose& T_world_other);

/** Collects the poses of scans that have one. */
class PoseTrack
{
 public:
  /** Poses farther apart in time than this are not interpolated [s]. */
  static constexpr double kMaxGap = 1.0;

  explicit PoseTrack(OutputFrame frame) : frame_(std::move(frame)) {}

  /** Takes one scan's result, in time order; those without a pose are left out. */
  void add(const ScanResult& result);

  /** At the scans' ends. */
  [[nodiscard]] const std::vector<TrackedPose>& poses() const { return poses_; }

  /** Interpolated with constant velocity between the poses around; the first pose during the first
   * scan. Nothing before and after, and in gaps. */
  [[nodiscard]] std::optional<TrackedPose> at(std::int64_t stamp_ns) const;

  [[nodiscard]] const OutputFrame& frame() const { return frame_; }

 private:
  OutputFrame frame_;
  std::vector<TrackedPose> poses_;
  std::int64_t begin_ns_ = 0;  //!< of the first scan
};

/** Chooses keyframes: the first pose, then whenever the body has moved or turned enough. */
class KeyFrameRule
{
 public:
  /** \param distance [m]
   * \param angle [rad] */
  KeyFrameRule(double distance, double angle) : distance_(distance), angle_(angle) {}

  /** True when \a T_world_body is a new keyframe. */
  [[nodiscard]] bool accept(const Pose& T_world_body);

 private:
  double distance_, angle_;
  std::optional<Pose> last_;
};

}  // namespace fastlio
