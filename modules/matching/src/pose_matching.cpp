// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Matching where only the pose is uncertain, from many starts: a search tries thousands of them.

#include "residual_model.h"
#include <fastlio/matching/scan_matcher.h>

#include <Eigen/Cholesky>

#include <memory>

namespace fastlio
{
namespace
{
// So many that a matcher of its own costs little beside them.
constexpr std::size_t kStartsPerTask = 32;

Matrix6 covarianceOf(const PoseStart& start)
{
  Matrix6 covariance = Matrix6::Zero();
  covariance.diagonal().head<3>() = start.attitude_variance;
  covariance.diagonal().tail<3>().setConstant(start.position_variance);
  return covariance;
}

/** Eq. 18-20 in six dimensions, from an iterate. How uncertain a start is follows a rule of thumb:
 * it is not moved to the tangent space of the iterate. */
Vector6 poseStep(const PoseStart& start, const Pose& iterate, const InformationSums& sums)
{
  const Vector6 weight = covarianceOf(start).diagonal().cwiseInverse();
  Vector6 off;
  off.head<3>() = logSO3(start.T_world_imu.R.transpose() * iterate.R);
  off.tail<3>() = iterate.p - start.T_world_imu.p;
  Matrix6 information = sums.HtRinvH;
  information.diagonal() += weight;
  return -information.llt().solve(sums.HtRinvz + weight.cwiseProduct(off));
}

bool isBelow(const IterationLimits& limits, const Vector6& step)
{
  return step.head<3>().cwiseAbs().maxCoeff() < limits.attitude &&
         step.tail<3>().cwiseAbs().maxCoeff() < limits.position;
}
}  // namespace

PoseMatch ScanMatcher::matchPose(
    const DeskewedScan& scan, const PoseStart& start, const MatchedMaps& maps,
    const MatchOptions& options)
{
  makeRoomFor(scan);
  MatchResult result;
  result.model = residualModelOf(options.measurement, covarianceOf(start));
  const Call call{scan, maps, options, result};
  PoseMatch match;
  match.T_world_imu = start.T_world_imu;
  Vector6 step = Vector6::Constant(1.0);
  for (int i = 0; i < options.limits.max_iterations && !isBelow(options.limits, step); ++i)
  {
    match.sums = measure(match.T_world_imu, i, call);
    if (match.sums.count < kMinEffectivePoints) return match;
    step = poseStep(start, match.T_world_imu, match.sums);
    if (!step.allFinite()) return match;
    match.T_world_imu.R *= expSO3(step.head<3>());
    match.T_world_imu.p += step.tail<3>();
  }
  match.T_world_imu.R = normalizeRotation(match.T_world_imu.R);
  match.updated = true;
  return match;
}

std::vector<PoseMatch> ScanMatcher::matchPoses(
    const DeskewedScan& scan, const std::vector<PoseStart>& starts, const MatchedMaps& maps,
    const MatchOptions& options)
{
  // One start shares the threads by its points, many by themselves.
  if (starts.size() == 1) return {matchPose(scan, starts.front(), maps, options)};
  std::vector<PoseMatch> matches(starts.size());
  workers_->forEachChunk(
      starts.size(), kStartsPerTask,
      [&](std::size_t, std::size_t first, std::size_t last)
      {
        ScanMatcher matcher(std::make_shared<const Workers>(1));
        for (std::size_t i = first; i < last; ++i)
          matches[i] = matcher.matchPose(scan, starts[i], maps, options);
      });
  return matches;
}

}  // namespace fastlio
