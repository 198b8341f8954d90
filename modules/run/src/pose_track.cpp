// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/twist.h>
#include <fastlio/math/time.h>
#include <fastlio/run/pose_track.h>

#include <algorithm>

namespace fastlio
{
namespace
{
/** Derivatives of the relative pose by the errors of a and b. */
Matrix6 byFormer(const Pose& a, const Pose& T_a_b)
{
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = -T_a_b.R.transpose();
  J.bottomLeftCorner<3, 3>() = skew(T_a_b.p);
  J.bottomRightCorner<3, 3>() = -a.R.transpose();
  return J;
}

Matrix6 byLatter(const Pose& a)
{
  Matrix6 J = Matrix6::Identity();
  J.bottomRightCorner<3, 3>() = a.R.transpose();
  return J;
}

/** As motions of the world, which are large far from its origin: in double precision. */
template <int Errors>
Eigen::Matrix<double, 6, Errors> twistBy(
    const Eigen::Matrix<float, 6, Errors, Eigen::DontAlign>& errors, const Pose& T_world_body)
{
  return twistJacobian(T_world_body) * errors.template cast<double>();
}

/** What errors make of the motion from the pose \a a to \a b. */
template <int Errors>
Eigen::Matrix<double, 6, Errors> motionBy(
    const Eigen::Matrix<float, 6, Errors, Eigen::DontAlign>& errors_a, const Pose& a,
    const Eigen::Matrix<float, 6, Errors, Eigen::DontAlign>& errors_b, const Pose& b)
{
  return byLatter(a) * twistJacobianInverse(b) * (twistBy(errors_b, b) - twistBy(errors_a, a));
}

/** Of the map's part. */
TwistCovariance unexplainedByBeams(const TrackedPose& pose)
{
  const Eigen::Matrix<double, 6, kBeamErrors> by_beams = pose.pose_by_beams.cast<double>();
  return twistCovariance(
      pose.map_covariance - pose.ambiguity_covariance - Matrix6(by_beams * by_beams.transpose()),
      pose.T_world_body);
}

// An angle counts as what it moves at this distance.
constexpr double kLeverArm = 10.0;  // [m]

/** In metres. */
Matrix6 asLengths(const Matrix6& pose_covariance)
{
  Vector6 lengths = Vector6::Ones();
  lengths.head<3>().setConstant(kLeverArm);
  return lengths.asDiagonal() * pose_covariance * lengths.asDiagonal();
}

/** What grows and what shrinks are errors of the motion in between alike. */
Matrix6 sizeOf(const Matrix6& change_of_pose)
{
  const Matrix6 moved = asLengths(change_of_pose);
  const Matrix6 size = positivePart(moved) + positivePart(-moved);
  Vector6 angles = Vector6::Ones();
  angles.head<3>().setConstant(1.0 / kLeverArm);
  return angles.asDiagonal() * size * angles.asDiagonal();
}

/** The change as seen from the pose \a at. A twist turns about the origin of the world; far from
 * it, a little of what grows and a little of what shrinks are both large. */
Matrix6 sizeOf(const TwistCovariance& change, const Pose& at)
{
  return sizeOf(poseCovariance(change, at));
}

/** A pose covariance of \a from, as one of \a to that is turned and not moved. */
Matrix6 turned(const Matrix6& covariance, const Pose& from, const Pose& to)
{
  Matrix6 J = Matrix6::Identity();
  J.topLeftCorner<3, 3>() = to.R.transpose() * from.R;
  return J * covariance * J.transpose();
}

/** What another place makes of the motion from \a a to \a b. It leaves the motion alone when it
 * moves all poses as one body, and when the same place with another heading is as likely
 * everywhere: then the covariance of heading and position stays, although the heading has a lever.
 */
Matrix6 sizeOfAmbiguity(const TrackedPose& a, const TrackedPose& b)
{
  const Matrix6 as_body = sizeOf(
      twistCovariance(b.ambiguity_covariance, b.T_world_body) -
          twistCovariance(a.ambiguity_covariance, a.T_world_body),
      b.T_world_body);
  const Matrix6 as_place = sizeOf(
      b.ambiguity_covariance - turned(a.ambiguity_covariance, a.T_world_body, b.T_world_body));
  return asLengths(as_place).trace() < asLengths(as_body).trace() ? as_place : as_body;
}

void setVelocity(TrackedPose& pose, const TrackedPose& from, const TrackedPose& to)
{
  const double dt = toSeconds(to.stamp_ns - from.stamp_ns);
  if (dt <= 0.0) return;
  const Pose& a = from.T_world_body;
  const Pose& b = to.T_world_body;
  pose.velocity = pose.T_world_body.R.transpose() * (b.p - a.p) / dt;
  pose.angular_velocity = logSO3(a.R.transpose() * b.R) / dt;
}
}  // namespace

RelativePose relativePose(const TrackedPose& a, const TrackedPose& b)
{
  RelativePose relative;
  relative.T_a_b = a.T_world_body.inverse() * b.T_world_body;
  const Matrix6 by_a = byFormer(a.T_world_body, relative.T_a_b);
  const Matrix6 by_b = byLatter(a.T_world_body);
  const Matrix6 own_a = positivePart(a.covariance - a.map_covariance);
  const Matrix6 own_b = positivePart(b.covariance - b.map_covariance);
  const TwistCovariance growth = unexplainedByBeams(b) - unexplainedByBeams(a);
  const MotionByBeams by_beams = motionByBeams(a, b);
  // The growth is negative where the odometry comes back to an older part of its map: the motion
  // then corrects what had grown on the way.
  const Matrix6 of_b = own_b + sizeOf(growth, b.T_world_body) + sizeOfAmbiguity(a, b);
  relative.covariance = by_a * own_a * by_a.transpose() + by_b * of_b * by_b.transpose() +
                        by_beams * by_beams.transpose();
  return relative;
}

MotionByBeams motionByBeams(const TrackedPose& a, const TrackedPose& b)
{
  return motionBy(a.pose_by_beams, a.T_world_body, b.pose_by_beams, b.T_world_body);
}

MotionByCalibration motionByCalibration(
    const PoseByCalibrationErrors& errors_a, const Pose& a, const PoseByCalibrationErrors& errors_b,
    const Pose& b)
{
  return motionBy(errors_a, a, errors_b, b);
}

RelativePose reversed(const RelativePose& motion)
{
  const Mat3& R = motion.T_a_b.R;
  RelativePose back;
  back.T_a_b = motion.T_a_b.inverse();
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = -R;
  J.bottomLeftCorner<3, 3>() = skew(back.T_a_b.p);
  J.bottomRightCorner<3, 3>() = -R.transpose();
  back.covariance = J * motion.covariance * J.transpose();
  return back;
}

PoseByBeams ofOtherBody(
    const PoseByBeams& by_beams, const Pose& T_world_body, const Pose& T_world_other)
{
  return (twistJacobianInverse(T_world_other) * twistBy(by_beams, T_world_body)).cast<float>();
}

void PoseTrack::add(const ScanResult& result)
{
  if (!hasPose(result.status)) return;
  const Pose& T_imu_body = frame_.T_imu_body;
  const PoseEstimate estimate = poseEstimateOf(result.filter, T_imu_body);
  TrackedPose pose;
  pose.stamp_ns = result.stamp_ns;
  pose.T_world_body = estimate.T_world_body;
  pose.covariance = estimate.covariance;
  pose.map_covariance =
      poseEstimateOf(result.filter.x.pose(), result.map_covariance, T_imu_body).covariance;
  pose.ambiguity_covariance =
      poseEstimateOf(result.filter.x.pose(), result.ambiguity_covariance, T_imu_body).covariance;
  pose.pose_by_beams = ofOtherBody(result.pose_by_beams, result.filter.x.pose(), pose.T_world_body);
  if (poses_.empty())
    begin_ns_ = result.begin_ns;
  else
    setVelocity(pose, poses_.back(), pose);
  poses_.push_back(pose);
}

std::optional<TrackedPose> PoseTrack::at(std::int64_t stamp_ns) const
{
  if (poses_.empty() || stamp_ns < begin_ns_) return std::nullopt;
  const auto next = std::lower_bound(
      poses_.begin(), poses_.end(), stamp_ns,
      [](const TrackedPose& pose, std::int64_t stamp) { return pose.stamp_ns < stamp; });
  if (next == poses_.end()) return std::nullopt;
  if (next == poses_.begin() || next->stamp_ns == stamp_ns)
  {
    TrackedPose pose = *next;
    pose.stamp_ns = stamp_ns;
    return pose;
  }
  const TrackedPose& before = *std::prev(next);
  const double gap = toSeconds(next->stamp_ns - before.stamp_ns);
  if (gap > kMaxGap) return std::nullopt;
  const double fraction = toSeconds(stamp_ns - before.stamp_ns) / gap;
  const Pose& a = before.T_world_body;
  const Pose& b = next->T_world_body;
  TrackedPose pose;
  pose.stamp_ns = stamp_ns;
  pose.T_world_body = interpolated(a, b, fraction);
  pose.covariance = (1.0 - fraction) * before.covariance + fraction * next->covariance;
  pose.map_covariance = (1.0 - fraction) * before.map_covariance + fraction * next->map_covariance;
  pose.ambiguity_covariance =
      (1.0 - fraction) * before.ambiguity_covariance + fraction * next->ambiguity_covariance;
  const PoseByBeams by_before = ofOtherBody(before.pose_by_beams, a, pose.T_world_body);
  const PoseByBeams by_next = ofOtherBody(next->pose_by_beams, b, pose.T_world_body);
  pose.pose_by_beams = by_before + static_cast<float>(fraction) * (by_next - by_before);
  setVelocity(pose, before, *next);
  return pose;
}

bool KeyFrameRule::accept(const Pose& T_world_body)
{
  if (last_)
  {
    const double moved = (T_world_body.p - last_->p).norm();
    const double turned = logSO3(last_->R.transpose() * T_world_body.R).norm();
    if (moved < distance_ && turned < angle_) return false;
  }
  last_ = T_world_body;
  return true;
}

}  // namespace fastlio
