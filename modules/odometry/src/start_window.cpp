// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "start_window.h"

#include "estimator.h"
#include <fastlio/initialization/motion_fit.h>
#include <fastlio/initialization/static_initializer.h>
#include <fastlio/matching/match_evidence.h>
#include <fastlio/math/statistics.h>
#include <fastlio/math/time.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
// Of the downsampling, for these scans: few points make no planes in a map of few scans.
constexpr int kWindowPoints = 10000;
// Normals are known to that: what leaks over to a direction that no plane faces is no information.
constexpr double kNormalStd = 0.015;  // [rad]

void describeEnd(const FilterState& end, StartPass& pass)
{
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(end.P.block<3, 3>(kVelocity, kVelocity));
  pass.velocity_std = std::sqrt(std::max(0.0, eigen.eigenvalues()[2]));
  pass.least_known = end.x.R.transpose() * eigen.eigenvectors().col(2);
}

/** What the scans leave open is anything, up to tens of m/s, and the next pass, which begins with
 * it, would not find back: there the velocity goes as far as its prior admits. */
void keepVelocityLikely(StartPass& pass)
{
  const Vec3 direction = pass.start.R * pass.least_known;
  const double ratio = pass.velocity_std / kFirstVelocityStd, share = ratio * ratio;
  pass.start.v -= share / (1.0 + share) * direction.dot(pass.start.v) * direction;
}
}  // namespace

StartWindow::StartWindow(
    const ScanQueue& scans, std::size_t count, const ImuBuffer& imu,
    const OdometryOptions& parameters)
    : scans_(scans), count_(count), imu_(imu), parameters_(parameters)
{
  const std::int64_t begin_ns = scans.front().span.latestStart();
  all_ = inputsOf(imu, begin_ns, scans[count - 1].span.end_ns, parameters.imu.hold);
  window_ = motionWindowUntil(all_.end_ns, kWindowPoints);
  first_scan_ = inputsOf(imu, begin_ns, scans.front().span.end_ns, parameters.imu.hold);
}

StartPass StartWindow::run(
    const FilterState& start, const OdometryOptions& parameters, bool far_off,
    std::optional<std::int64_t> stamp_ns) const
{
  Estimator estimator(parameters);
  MotionWindow trial = window_;
  trial.trial = true;
  trial.pull_in = far_off;
  estimator.start(start, stamp_ns.value_or(scans_.front().span.latestStart()), trial);
  ScanResult last;
  std::size_t unmatched = 0;
  std::vector<double> contrast;  // of the least known direction to others
  std::vector<double> inliers;
  std::vector<StampedPose> poses;
  for (std::size_t i = 0; i < count_; ++i)
  {
    if (scans_[i].span.end_ns <= estimator.stamp()) continue;  // out of order
    last = estimator.process(scans_[i].scan, scans_[i].span, imu_);
    const Vector6& information = last.statistics.information_eigenvalues;
    if (information[2] > 0.0) contrast.push_back(information[0] / information[2]);
    if (i > 0) inliers.push_back(inlierRatio(last.statistics, last.statistics.points_downsampled));
    poses.push_back({last.stamp_ns, last.filter.x.pose()});
    unmatched += i > 0 && last.status != ScanStatus::Tracking ? 1 : 0;
  }
  StartPass pass;
  pass.blind = median(contrast) < kNormalStd * kNormalStd;
  pass.inlier_ratio = inliers.empty() ? 0.0 : median(inliers);
  if (2 * unmatched > count_) pass.problem = "most scans do not match each other";
  const StampedPose &first = poses.front(), &end = poses.back();
  pass.mean_speed =
      (end.T_world_body.p - first.T_world_body.p).norm() / toSeconds(end.stamp_ns - first.stamp_ns);
  const Inputs between = inputsOf(imu_, first.stamp_ns, end.stamp_ns, parameters_.imu.hold);
  pass.rate_error = unexplainedRate(first, end, between, start.x.gyro_bias);
  describeStart(last.filter, poses, between, pass);
  describeEnd(last.filter, pass);
  keepVelocityLikely(pass);
  return pass;
}

void StartWindow::describeStart(
    const FilterState& end, const std::vector<StampedPose>& poses, const Inputs& between,
    StartPass& pass) const
{
  const StampedPose& first = poses.front();
  MotionFitPrior prior;
  prior.gyro_bias = end.x.gyro_bias;
  prior.g = parameters_.initialization.gravity * end.x.g.normalized();
  prior.gravity_std = kGravityStd;
  const MotionFit fit = fitMotion(poses, between.samples, prior);
  if (!fit.solved) pass.problem = "too few of the first scans match each other";

  NavState x = end.x;
  x.R = first.T_world_body.R;
  x.v = fit.velocity;
  x.g = fit.g;
  x.accel_bias.setZero();
  x = propagatedBack(x, first_scan_);
  const Mat3 R_imu_world = x.R.transpose();
  pass.start =
      startState(R_imu_world * x.g, R_imu_world * x.v, x.gyro_bias, parameters_.initialization);
}

}  // namespace fastlio
