// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/localmap/outage_search.h>
#include <fastlio/matching/match_evidence.h>
#include <fastlio/matching/pose_search.h>
#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/time.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
// The scans of half a second, five at 10 Hz, know the velocity to some centimetres per second.
constexpr double kMeasuringTime = 0.5;  // [s]
constexpr int kFewestMeasurements = 4;
// Scans that do not match each other for so long will not determine it.
constexpr double kLongestMeasuring = 1.0;  // [s]
// So long the map is searched, measuring included: fifteen scans at 10 Hz [s].
constexpr double kSearchTime = 1.5;
constexpr double kMatchStd = 0.03;     // of a way between two scans [m]
constexpr double kUnknownStd = 100.0;  // of a velocity that the surroundings leave open [m/s]
// A map of few scans is sparse: outdoors, little of a scan matches the one before.
constexpr double kFewestInliers = 0.05;
// The wrong velocity shears the scans, so that they do not fit each other as a map does; when so
// much of them matches, it is the same place.
constexpr double kEnoughInliers = 0.5;
constexpr double kShearedInnovation = 20.0;
constexpr double kMostSigmas = 4.0;  // of the measured velocity, from the predicted one
// The velocity of the prediction may be off by metres per second: from wide to narrow. A start that
// is wider than three standard deviations would only be pulled away.
constexpr double kStartStds[] = {0.3, 0.1, 0.05};  // [m]
constexpr double kWidestStart = 3.0;
constexpr double kTurnStd = 0.01;  // the gyro knows how the scans are turned [rad]
constexpr int kIterations = 5;

/** Scans that match at a wrong place contradict the prediction. */
bool isPossible(const VelocityError& error, const FilterState& predicted)
{
  const Mat3 S = predicted.P.block<3, 3>(kVelocity, kVelocity) + error.covariance;
  return squaredMahalanobis(error.mean, S) < kMostSigmas * kMostSigmas;
}

bool matchesWell(const MatchResult& match, std::size_t points)
{
  const double inlier_ratio = inlierRatio(match.update.last.count, points);
  const double innovation = normalizedInnovation(match.update);
  return (inlier_ratio >= kFewestInliers && innovation <= kMaxInnovation) ||
         (inlier_ratio >= kEnoughInliers && innovation <= kShearedInnovation);
}
}  // namespace

FilterState correctedByVelocity(const FilterState& predicted, const VelocityError& error)
{
  const Eigen::Matrix<double, kStateDim, 3> PHt = predicted.P.middleCols<3>(kVelocity);
  Eigen::Matrix3d S = predicted.P.block<3, 3>(kVelocity, kVelocity);
  S += error.covariance;
  const Eigen::Matrix<double, 3, kStateDim> Kt = S.llt().solve(PHt.transpose());
  FilterState corrected;
  const StateVector correction = Kt.transpose() * error.mean;
  corrected.x = boxplus(predicted.x, correction);
  const StateMatrix removed = PHt * Kt;
  corrected.P = predicted.P - 0.5 * (removed + removed.transpose());
  return corrected;
}

OutageSearch::OutageSearch(
    const OdometryOptions& options, std::shared_ptr<const Workers> workers,
    const FilterState& predicted, std::int64_t begin_ns, double unseen_s)
    : options_(options),
      scans_(options, std::move(workers)),
      begin_ns_(begin_ns),
      needed_(positionStd(predicted).maxCoeff() > kUnambiguousStd),
      unseen_(isOutage(unseen_s))
{
}

bool OutageSearch::measuresVelocity(std::int64_t end_ns) const
{
  return needed_ && !known_ && toSeconds(end_ns - begin_ns_) < kLongestMeasuring;
}

bool OutageSearch::isOver(std::int64_t end_ns) const
{
  return toSeconds(end_ns - begin_ns_) >= kSearchTime;
}

FilterState OutageSearch::withVelocity(
    const DeskewedScan& scan, const FilterState& predicted, std::int64_t end_ns,
    ScanMatcher& matcher)
{
  if (known_ || scan.surfaces.size() < kMinEffectivePoints) return predicted;
  const double seconds = toSeconds(end_ns - begin_ns_);
  if (scans_.empty())
    insert(scan, predicted.x);
  else
    measure(scan, predicted, seconds, matcher);
  known_ = measured_ >= kFewestMeasurements && seconds >= kMeasuringTime &&
           isPossible(error_, predicted);
  return known_ ? correctedByVelocity(predicted, error_) : predicted;
}

void OutageSearch::measure(
    const DeskewedScan& scan, const FilterState& predicted, double seconds, ScanMatcher& matcher)
{
  MatchOptions options = ordinaryMatching(options_);
  options.association_iterations = options.limits.max_iterations = kIterations;
  Pose at = predicted.x.pose();
  at.p += seconds * error_.mean;
  MatchResult match;
  const Mat3 velocity =
      measured_ > 0 ? error_.covariance : Mat3(predicted.P.block<3, 3>(kVelocity, kVelocity));
  const double expected = kMatchStd + seconds * std::sqrt(velocity.diagonal().maxCoeff());
  for (const double std : kStartStds)
  {
    if (std > kWidestStart * expected) continue;
    match = matcher.match(scan, startAt(predicted, at, {std, kTurnStd}), scans_.matched(), options);
    if (!match.update.updated) return;
    at = match.update.posterior.x.pose();
  }
  if (!matchesWell(match, scan.surfaces.size())) return;
  error_.mean = (at.p - predicted.x.p) / seconds;
  const Mat3 of_match = match.update.posterior.P.block<3, 3>(kPosition, kPosition);
  error_.covariance = (of_match + kMatchStd * kMatchStd * Mat3::Identity()) / (seconds * seconds);
  for (const MotionDirection& motion : unconstrainedMotions(match.constraints))
    if (!motion.is_rotation)
      error_.covariance += kUnknownStd * kUnknownStd * motion.axis * motion.axis.transpose();
  ++measured_;
  insert(scan, match.update.posterior.x);
}

void OutageSearch::insert(const DeskewedScan& scan, const NavState& x)
{
  const Pose T_world_scan = scanPose(x, scan.compensation);
  const std::size_t points = scan.surfaces.size();
  points_.resize(points);
  transformToWorld(scan.surfaces, T_world_scan, 0, points, points_);
  scans_.insert(
      scan, points_, InsertionError{}, T_world_scan, scanPoseJacobian(x, scan.compensation), x.p);
}

}  // namespace fastlio
