// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "classify.h"

#include "map_search.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kTrouble = 0.5;
constexpr double kKnownDegeneracy = 0.6;  // a direction that is left to the inertial data
constexpr double kPredicted = 0.25;
// Position error along a degenerate direction that few users of a trajectory can live with [m].
constexpr double kMaxDegenerateStd = 0.5;
// Corrections of the prediction over what its covariance explains. Realistic sensors reach 8; a
// mounting that is 5 deg wrong 29.
constexpr double kMaxMotionInnovation = 15.0;
// An estimate from the motion is good to some tenths of a degree.
constexpr double kMaxMountingError = 0.017453292519943295;  // [rad]; 1 deg
constexpr int kSparseMapScans = 20;
// Smallest eigenvalue of H^T R^-1 H: the scan knows each direction to 0.1 m or 0.1 rad.
constexpr double kMinInformation = 100.0;
// Fraction of the time that inertial data may be in doubt: longer bridges bend the scan.
constexpr double kMaxInflatedRatio = 0.25;
// Beyond these, the filter explains something else by its biases.
constexpr double kMaxGyroBias = 0.17453292519943295;  // [rad/s]; 10 deg/s
constexpr double kMaxAccelBias = 2.0;                 // [m/s^2]
// From scan to scan: five periods of the usual 10 Hz [s].
constexpr double kMaxScanInterval = 0.5;

/** Health of a measure that must not exceed a limit: 1 at zero, 1/2 at the limit. */
double below(double measure, double limit)
{
  return std::clamp(1.0 - 0.5 * measure / limit, 0.0, 1.0);
}

/** Health of a measure that must reach a limit: 1/2 there, 1 at twice as much. */
double above(double measure, double limit)
{
  return limit > 0.0 ? std::clamp(0.5 * measure / limit, 0.0, 1.0) : 1.0;
}

double inlierRatio(const ScanStatistics& s, std::size_t points)
{
  return points > 0 ? static_cast<double>(s.points_effective) / static_cast<double>(points) : 0.0;
}

/** Keeps the worst. \param reason makes the text, which is needed in trouble only */
template <typename Reason>
void consider(ScanHealth& health, double value, HealthCause cause, const Reason& reason)
{
  if (value >= health.value) return;
  health.value = value;
  health.cause = cause;
  health.reason = value < kTrouble ? reason() : std::string();
}

void considerInlierRatio(const ScanStatistics& s, ScanHealth& health)
{
  consider(
      health, above(inlierRatio(s, s.points_downsampled), kMinUsualFraction * s.usual_inlier_ratio),
      HealthCause::FewMatches,
      [&]
      {
        return mrpt::format(
            "%zu of %zu points match the map, less than %g of the fraction that matched before, "
            "%.3f",
            s.points_effective, s.points_downsampled, kMinUsualFraction, s.usual_inlier_ratio);
      });
}

void considerMatches(const ScanStatistics& s, ScanHealth& health)
{
  consider(
      health, below(s.normalized_innovation, kMaxInnovation), HealthCause::LargeResidual,
      [&]
      {
        return mrpt::format(
            "the residuals are %.1f times what their noise explains, more than %g: "
            "wrong pose, extrinsic, time offset or point times?",
            s.normalized_innovation, kMaxInnovation);
      });
  if (s.constraints.unconstrained > 0) return;
  consider(
      health, above(s.information_eigenvalues[0], kMinInformation),
      HealthCause::DegenerateDirection,
      [&]
      {
        return mrpt::format(
            "the surroundings leave a direction open: smallest eigenvalue of the information %.3g, "
            "less than %g",
            s.information_eigenvalues[0], kMinInformation);
      });
}

/** A direction that is left to the inertial data is fine as long as they know it well enough. */
void considerDegenerateDirections(const ScanResult& result, ScanHealth& health)
{
  const ScanConstraints& constraints = result.statistics.constraints;
  if (constraints.unconstrained == 0) return;
  const Matrix6 own = result.filter.P.topLeftCorner<6, 6>() - result.map_covariance;
  const double std = std::sqrt(own.bottomRightCorner<3, 3>().diagonal().maxCoeff());
  consider(
      health, std::min(kKnownDegeneracy, below(std, kMaxDegenerateStd)),
      HealthCause::DegenerateDirection,
      [&]
      {
        const MotionDirection open = unconstrainedMotions(constraints).front();
        return mrpt::format(
            "the surroundings do not constrain the %s (%.2f, %.2f, %.2f): the position is "
            "uncertain by %.2f m, more than %g m",
            open.is_rotation ? "rotation about" : "motion along", open.axis.x(), open.axis.y(),
            open.axis.z(), std, kMaxDegenerateStd);
      });
}

/** What scans correct again and again, the inertial data got wrong, or the scans' pose did. */
void considerMotion(const ScanStatistics& s, ScanHealth& health)
{
  if (s.mounting_error)
    consider(
        health, below(s.mounting_error->angle, kMaxMountingError), HealthCause::MotionDisagreement,
        [&]
        {
          return mrpt::format(
              "scans and inertial data show a mounting of the LiDAR that is %.1f deg off the one "
              "in use, more than %.1f",
              kDegPerRad * s.mounting_error->angle, kDegPerRad * kMaxMountingError);
        });
  consider(
      health, below(s.motion_innovation, kMaxMotionInnovation), HealthCause::MotionDisagreement,
      [&]
      {
        return mrpt::format(
            "scans and inertial data see different motions, %.0f times as far apart as their noise "
            "explains: wrong mounting (T_imu_lidar), units, point times or clocks?",
            s.motion_innovation);
      });
}

void considerInertialData(double inflated, const NavState& x, ScanHealth& health)
{
  consider(
      health, below(inflated, kMaxInflatedRatio), HealthCause::InertialData,
      [&]
      {
        return mrpt::format(
            "%.0f %% of the inertial data since the scan before are missing, clipped or absurd, "
            "more than %.0f %%",
            100.0 * inflated, 100.0 * kMaxInflatedRatio);
      });
  consider(
      health, below(x.gyro_bias.norm(), kMaxGyroBias), HealthCause::Bias,
      [&]
      {
        return mrpt::format(
            "the gyro's bias has run to %.2f deg/s, more than %.2f",
            kDegPerRad * x.gyro_bias.norm(), kDegPerRad * kMaxGyroBias);
      });
  consider(
      health, below(x.accel_bias.norm(), kMaxAccelBias), HealthCause::Bias,
      [&]
      {
        return mrpt::format(
            "the accelerometer's bias has run to %.2f m/s^2, more than %.2f", x.accel_bias.norm(),
            kMaxAccelBias);
      });
}

std::string fewMatches(const ScanOutcome& outcome, const ScanStatistics& s)
{
  return mrpt::format(
      "%zu of %zu points match the map, at least %zu are needed; "
      "%.2f s on inertial data alone, position uncertain by %.3f m%s",
      s.points_effective, outcome.points, kMinEffectivePoints, outcome.unaided_s,
      outcome.position_std,
      outcome.prediction_finite ? "" : "; the inertial data overflowed the prediction");
}

/** There is no map yet, and the scan cannot begin one. */
std::string emptyScan(
    const ScanOutcome& outcome, const ScanStatistics& s, const OdometryOptions& options)
{
  return mrpt::format(
      "%zu of %zu points are left, at least %zu are needed to begin a map: %zu without an echo, "
      "%zu "
      "nearer than lidar.min_range (%g m), %zu farther than lidar.max_range (%g m)",
      outcome.points, s.points_in, kMinEffectivePoints, s.dropped_invalid, s.dropped_near,
      options.lidar.min_range, s.dropped_far, options.lidar.max_range);
}

std::string foundAgain(const PoseSearchResult& search)
{
  return mrpt::format(
      "the pose is found again in the map: %.0f %% of the points match, %zu places were tried",
      100.0 * search.best->inlier_ratio, search.candidates);
}

std::string searchFailure(const ScanOutcome& outcome)
{
  const PoseSearchResult& search = *outcome.search;
  if (!search.complete)
    return mrpt::format(
        "the position is so uncertain (%.1f m) that the %zu places that were tried are not all; "
        "%.2f s on inertial data alone",
        outcome.position_std, search.candidates, outcome.unaided_s);
  const PoseCandidate best = search.best.value_or(PoseCandidate{});
  return mrpt::format(
      "none of %zu places within the prediction's uncertainty (%.2f m) matches convincingly: the "
      "best has %.0f %% inliers with a mean z^2/r of %.1f, its rival %.0f %% of its score; %.2f s "
      "on inertial data alone",
      search.candidates, outcome.position_std, 100.0 * best.inlier_ratio, best.innovation,
      best.score > 0.0 ? 100.0 * search.rival_score / best.score : 0.0, outcome.unaided_s);
}

std::string unconvincingMatch(const ScanOutcome& outcome, const ScanStatistics& s)
{
  return mrpt::format(
      "%zu of %zu points match the map with a mean z^2/r of %.2f, which is no convincing match; "
      "the last one was %.2f s ago",
      s.points_effective, outcome.points, s.normalized_innovation, outcome.unaided_s);
}

std::string bridgedGap(double gap_s, double max_gap)
{
  return mrpt::format(
      "%.2f s without inertial samples (imu.max_gap is %.2f s): bridged with the last rate and "
      "acceleration",
      gap_s, max_gap);
}

std::string relocalisationFailure(
    const ScanOutcome& outcome, const ScanStatistics& s, const InitializationOptions& p)
{
  return mrpt::format(
      "%.0f %% of the points match the given map around the initial pose, at least %.0f %% are "
      "needed; is the pose within initialization.pose_position_std "
      "(%.2f m) and pose_yaw_std of the true one?",
      100.0 * inlierRatio(s, std::max<std::size_t>(outcome.points, 1)),
      100.0 * kGivenMapInlierRatio, p.pose_position_std);
}

/** The state is not trusted: the prediction overflowed, or no scan has corrected it for long. */
bool isDiverged(const ScanOutcome& outcome, const OdometryOptions& options)
{
  return !outcome.prediction_finite || outcome.unaided_s > options.measurement.max_unaided_time;
}

/** Why the scan did not correct the state; empty when it did and nothing is worth a word. */
std::string trackingMessage(
    const ScanOutcome& outcome, const ScanStatistics& s, const OdometryOptions& options)
{
  const bool diverged = isDiverged(outcome, options);
  if (outcome.search && outcome.prediction_finite)
    return outcome.search->accepted ? foundAgain(*outcome.search) : searchFailure(outcome);
  if (diverged && outcome.updated) return unconvincingMatch(outcome, s);
  if (outcome.map_was_empty && !outcome.begins_map) return emptyScan(outcome, s, options);
  if (diverged || (!outcome.updated && !outcome.begins_map)) return fewMatches(outcome, s);
  if (outcome.imu_gap_s > options.imu.max_gap)
    return bridgedGap(outcome.imu_gap_s, options.imu.max_gap);
  return {};
}

std::string messageOf(
    ScanStatus status, const ScanOutcome& outcome, const ScanStatistics& s,
    const OdometryOptions& options)
{
  if (outcome.place == ScanOutcome::Place::OutsideGivenMap)
    return relocalisationFailure(outcome, s, options.initialization);
  if (outcome.place == ScanOutcome::Place::InMap) return trackingMessage(outcome, s, options);
  if (status == ScanStatus::Tracking)
    return mrpt::format(
        "the map is found again after a new start, %zu of %zu points match it", s.points_effective,
        outcome.points);
  if (status == ScanStatus::FirstScan)
    return mrpt::format(
        "a new map is begun at the pose that was carried over, which is uncertain by %.2f m",
        outcome.position_std);
  return "a new start, looking for the map: " + trackingMessage(outcome, s, options);
}
}  // namespace

bool matchesAsUsual(const ScanStatistics& statistics, std::size_t points)
{
  return inlierRatio(statistics, points) >= kMinUsualFraction * statistics.usual_inlier_ratio;
}

ScanStatus statusOf(const ScanOutcome& outcome, const OdometryOptions& options)
{
  if (outcome.place == ScanOutcome::Place::OutsideGivenMap) return ScanStatus::Initializing;
  if (isDiverged(outcome, options)) return ScanStatus::Diverged;
  if (outcome.begins_map) return ScanStatus::FirstScan;
  if (outcome.updated) return ScanStatus::Tracking;
  return outcome.place == ScanOutcome::Place::InMap ? ScanStatus::PredictionOnly
                                                    : ScanStatus::Diverged;
}

ScanHealth healthOf(const ScanResult& result, const HealthContext& context)
{
  ScanHealth health;
  const double interval_s = toSeconds(result.stamp_ns - context.since_ns);
  const auto message = [&] { return result.message; };
  if (result.status == ScanStatus::Initializing)
    consider(health, 0.0, HealthCause::Starting, message);
  else if (result.status == ScanStatus::Diverged)
    consider(health, 0.0, HealthCause::Lost, message);
  else if (result.status == ScanStatus::PredictionOnly)
    consider(health, kPredicted, HealthCause::NoMatch, message);
  else if (result.status == ScanStatus::Tracking)
  {
    if (!context.map_is_sparse) considerInlierRatio(result.statistics, health);
    considerMatches(result.statistics, health);
    considerDegenerateDirections(result, health);
    considerMotion(result.statistics, health);
  }
  considerInertialData(context.inflated_ratio, result.filter.x, health);
  consider(
      health, below(interval_s, kMaxScanInterval), HealthCause::ScanTiming,
      [&]
      {
        return mrpt::format(
            "%.2f s since the scan before, more than %g: scans are "
            "missing, or the LiDAR's stamps jump",
            interval_s, kMaxScanInterval);
      });
  return health;
}

void ScanClassifier::classify(
    const ScanOutcome& outcome, const std::vector<NoiseInflation>& inflations, ScanResult& result)
{
  result.status = statusOf(outcome, options_);
  result.message = messageOf(result.status, outcome, result.statistics, options_);

  HealthContext context;
  context.since_ns = previous_ns_ == 0 ? result.begin_ns : previous_ns_;
  context.inflated_ratio = inflatedRatio(inflations, context.since_ns, result.stamp_ns);
  context.map_is_sparse = scans_until_dense_ > 0;
  result.health = healthOf(result, context);
  previous_ns_ = result.stamp_ns;
  if (result.status == ScanStatus::FirstScan)
    scans_until_dense_ = kSparseMapScans;
  else if (result.status == ScanStatus::Tracking)
    scans_until_dense_ = std::max(0, scans_until_dense_ - 1);
}

ScanResult classifyUnprocessed(const QueuedScan& queued, const std::string& why, bool started)
{
  ScanResult result;
  result.begin_ns = queued.span.begin_ns;
  result.stamp_ns = queued.span.end_ns;
  result.statistics.points_in = queued.scan.points.size();
  result.status = started ? ScanStatus::Diverged : ScanStatus::Initializing;
  result.message = why;
  result.health = {0.0, started ? HealthCause::Lost : HealthCause::Starting, why};
  return result;
}

}  // namespace fastlio
