// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/loops/corrected_trajectory.h>
#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/time.h>
#include <fastlio/posegraph/odometry_chain.h>
#include <fastlio/run/pose_output.h>

#include <algorithm>

namespace fastlio
{
namespace
{
/** Takes the position error of a pose from the frame of the body to the world. */
Matrix6 toWorld(const Pose& T_world_imu)
{
  Matrix6 turn = Matrix6::Identity();
  turn.bottomRightCorner<3, 3>() = T_world_imu.R;
  return turn;
}

/** How the first pose's error of the extrinsic moves a later pose, plus a multiple of that of the
 * later pose itself. */
Matrix6 byFirst(const Pose& first, const Pose& T_world_imu, double own)
{
  const Pose back = T_world_imu.inverse() * first;  // A^-1
  Matrix6 J = own * Matrix6::Identity();
  J.topLeftCorner<3, 3>() += back.R;
  J.bottomLeftCorner<3, 3>() += skew(back.p) * back.R;
  J.bottomRightCorner<3, 3>() += back.R;
  return J;
}

Matrix6 extrinsicMomentOf(const Submap& submap)
{
  return submap.calibration_moment.topLeftCorner<6, 6>().cast<double>();
}
}  // namespace

Matrix6 extrinsicCovariance(const Pose& first, const Pose& T_world_imu, const Matrix6& moment)
{
  const Matrix6 J = byFirst(first, T_world_imu, -1.0);
  const Matrix6 turn = toWorld(T_world_imu);
  return turn * J * moment * J.transpose() * turn.transpose();
}

Matrix6 extrinsicCovariance(
    const Pose& first, const Matrix6& moment_of_first, const Pose& T_world_imu,
    const Matrix6& moment)
{
  const Matrix6 J = byFirst(first, T_world_imu, 0.0);
  const Matrix6 turn = toWorld(T_world_imu);
  return turn * (J * moment_of_first * J.transpose() + moment) * turn.transpose();
}

CorrectedTrajectory::CorrectedTrajectory(const MappingResult& result, std::size_t session)
    : changes_(result.moves(session))
{
  if (!result.estimate.nodes.empty()) first_ = result.estimate.nodes.front();
  for (std::size_t i = 0; i < result.submaps.size(); ++i)
  {
    const Submap& submap = result.submaps[i];
    if (submap.session != session) continue;
    nodes_.push_back(
        {submap.reference, result.estimate.nodes.at(i), result.estimate.covariances.at(i)});
    extrinsic_moment_ = extrinsicMomentOf(submap);
  }
  if (result.submaps.empty() || result.areOneRig(result.submaps.front().session, session)) return;
  for (const Submap& submap : result.submaps)
    if (submap.session == result.submaps.front().session)
      moment_of_first_ = extrinsicMomentOf(submap);
}

CorrectedTrajectory::Place CorrectedTrajectory::placeOf(std::int64_t stamp_ns) const
{
  const auto after = std::upper_bound(
      nodes_.begin(), nodes_.end(), stamp_ns,
      [](std::int64_t stamp, const Node& node) { return stamp < node.odometry.stamp_ns; });
  if (after == nodes_.begin()) return {&nodes_.front(), nullptr, 0.0};
  const Node& before = *std::prev(after);
  if (after == nodes_.end()) return {&before, nullptr, 0.0};
  const double length = toSeconds(after->odometry.stamp_ns - before.odometry.stamp_ns);
  return {&before, &*after, toSeconds(stamp_ns - before.odometry.stamp_ns) / length};
}

Pose CorrectedTrajectory::poseAt(const Place& place, const Pose& T_world_imu) const
{
  const auto movedWith = [&T_world_imu](const Node& node)
  { return node.corrected * (node.odometry.T_world_body.inverse() * T_world_imu); };
  Pose a = movedWith(*place.before);
  if (place.after == nullptr) return a;
  const Pose between = interpolated(a, movedWith(*place.after), place.fraction);
  return {normalizeRotation(between.R), between.p};
}

Matrix6 CorrectedTrajectory::byExtrinsic(const Pose& T_world_imu) const
{
  if (!moment_of_first_) return extrinsicCovariance(first_, T_world_imu, extrinsic_moment_);
  return extrinsicCovariance(first_, *moment_of_first_, T_world_imu, extrinsic_moment_);
}

Pose CorrectedTrajectory::correctionAt(std::int64_t stamp_ns, const Pose& T_world_imu) const
{
  if (!changes_ || nodes_.empty()) return {};
  return poseAt(placeOf(stamp_ns), T_world_imu) * T_world_imu.inverse();
}

namespace
{
/** Turns what the filter has in the world beside the pose: velocity and gravity. */
void turnWorld(const Mat3& turn, FilterState& filter)
{
  filter.x.v = turn * filter.x.v;
  filter.x.g = turn * filter.x.g;
  StateMatrix T = StateMatrix::Identity();
  T.block<3, 3>(kVelocity, kVelocity) = turn;
  T.block<3, 3>(kGravity, kGravity) = turn;
  filter.P = transformedCovariance(T, filter.P);
}
}  // namespace

ScanResult CorrectedTrajectory::corrected(const ScanResult& result) const
{
  if (!changes_ || nodes_.empty() || !hasPose(result.status)) return result;
  ScanResult moved = result;
  const Place place = placeOf(result.stamp_ns);
  const Pose odometry = result.filter.x.pose();
  const Pose pose = poseAt(place, odometry);
  turnWorld(pose.R * odometry.R.transpose(), moved.filter);
  moved.filter.x.R = pose.R;
  moved.filter.x.p = pose.p;
  const TrackedPose here = mappingPoseOf(result);
  const Node& node = *place.before;
  OdometryChain chain(node.corrected, node.covariance);
  chain.advance(relativePose(node.odometry, here));
  Matrix6 covariance = chain.covariance();
  if (place.after != nullptr)
    covariance = (1.0 - place.fraction) * covariance + place.fraction * place.after->covariance;
  const Matrix6 by_extrinsic = byExtrinsic(pose);
  covariance += by_extrinsic;
  // What the pose shares with the rest of the state is not known any more.
  moved.filter.P.topRows<6>().setZero();
  moved.filter.P.leftCols<6>().setZero();
  moved.filter.P.topLeftCorner<6, 6>() = covariance;
  moved.map_covariance = covariance;
  moved.calibration_covariance = by_extrinsic;
  moved.ambiguity_covariance.setZero();  // the covariance of the graph contains it
  moved.pose_by_beams.setZero();
  return moved;
}

}  // namespace fastlio
