// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/health/classify.h>
#include <fastlio/localmap/map_search.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace fastlio
{
namespace
{
constexpr int kSparseMapScans = 20;
// A scan among others that leave a direction open may be wrong about it [ns].
constexpr std::int64_t kWellConstrained = 1'000'000'000;

/** The scan is too small, and why. \param purpose what more points are needed for */
std::string fewPoints(
    const ScanOutcome& outcome, const ScanStatistics& s, const OdometryOptions& options,
    const char* purpose)
{
  return mrpt::format(
      "%zu of %zu points are left, at least %zu are needed to %s: %zu without an echo, %zu nearer "
      "than lidar.min_range (%g m), %zu farther than lidar.max_range (%g m)",
      outcome.points, s.points_in, kMinEffectivePoints, purpose, s.dropped_invalid, s.dropped_near,
      options.lidar.min_range, s.dropped_far, options.lidar.max_range);
}

std::string fewMatches(
    const ScanOutcome& outcome, const ScanStatistics& s, const OdometryOptions& options)
{
  const std::string why = outcome.points < kMinEffectivePoints
                              ? fewPoints(outcome, s, options, "match the map")
                              : mrpt::format(
                                    "%zu of %zu points match the map, at least %zu are needed",
                                    s.points_effective, outcome.points, kMinEffectivePoints);
  return mrpt::format(
      "%s; %.2f s on inertial data alone, position in the map uncertain by %.3f m%s", why.c_str(),
      outcome.unaided_s, outcome.position_std,
      outcome.prediction_finite ? "" : "; the inertial data overflowed the prediction");
}

std::string foundAgain(const PoseSearchResult& search)
{
  return mrpt::format(
      "the pose is found again in the map: %.0f %% of the points match; places that were tried: "
      "%zu",
      100.0 * search.best->inlier_ratio, search.candidates);
}

/** In one clause. The limit is the least that any map asks for (PoseSearchLimits). */
std::string whyNotFound(const PoseSearchResult& search)
{
  if (!search.best) return "too few points match at each place that was tried";
  const PoseCandidate& best = *search.best;
  const double matching = 100.0 * best.inlier_ratio;
  const PoseSearchLimits limits;
  if (best.inlier_ratio < limits.min_inlier_ratio)
    return mrpt::format(
        "%.0f %% of the points match, at least %.0f %% are needed", matching,
        100.0 * limits.min_inlier_ratio);
  if (best.innovation > limits.max_innovation)
    return mrpt::format(
        "%.0f %% of the points match, but they lie too far from its surfaces", matching);
  if (search.rival_score >= kRivalShare * best.score)
    return mrpt::format(
        "%.0f %% of the points match, but another place fits nearly as well", matching);
  if (!search.complete)
    return mrpt::format(
        "%.0f %% of the points match, but the pose is so uncertain that not every place could be "
        "tried",
        matching);
  return mrpt::format(
      "%.0f %% of the points match, which is too few for this map, or the place is too far away",
      matching);
}

std::string searchFailure(const ScanOutcome& outcome)
{
  const PoseSearchResult& search = *outcome.search;
  const PoseCandidate best = search.best.value_or(PoseCandidate{});
  return mrpt::format(
      "the scan does not fit the map near the predicted pose: %s; %.2f s on inertial data alone "
      "(places tried: %zu, position uncertain by %.2f m, mean z^2/r %.1f, score of the rival "
      "%.0f %%)",
      whyNotFound(search).c_str(), outcome.unaided_s, search.candidates, outcome.position_std,
      best.innovation, best.score > 0.0 ? 100.0 * search.rival_score / best.score : 0.0);
}

std::string afterOutage(const ScanOutcome& outcome)
{
  if (outcome.begins_map)
    return mrpt::format(
        "the map does not show the place: a new one begins at the predicted pose, which is "
        "uncertain by %.2f m",
        outcome.position_std);
  return mrpt::format(
      "the scans measure the velocity before the map is searched; position uncertain by %.2f m",
      outcome.position_std);
}

std::string unconvincingMatch(const ScanOutcome& outcome, const ScanStatistics& s)
{
  return mrpt::format(
      "%zu of %zu points match the map, but they lie too far from its surfaces: no convincing "
      "match; the last one was %.2f s ago (mean z^2/r %.2f)",
      s.points_effective, outcome.points, outcome.unaided_s, s.normalized_innovation);
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
  const double ratio = inlierRatio(s, std::max<std::size_t>(outcome.points, 1));
  std::string fault = mrpt::format(
      "%.0f %% of the points match the given map around the initial pose, at least %.0f %% are "
      "needed",
      100.0 * ratio, 100.0 * kGivenMapInlierRatio);
  if (ratio >= kGivenMapInlierRatio && s.normalized_innovation > kWrongPoseInnovation)
    fault = mrpt::format(
        "%.0f %% of the points match the given map around the initial pose, but badly: their "
        "residuals are %.1f times what the noise explains, at most %.0f are allowed",
        100.0 * ratio, s.normalized_innovation, kWrongPoseInnovation);
  return fault + mrpt::format(
                     ": give an initial pose that is nearer to the true one, or search farther "
                     "with a larger initialization.pose_position_std (now %.2f m) and pose_yaw_std",
                     p.pose_position_std);
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
  if (outcome.after_outage && outcome.prediction_finite) return afterOutage(outcome);
  if (diverged && outcome.updated) return unconvincingMatch(outcome, s);
  if (outcome.map_was_empty && !outcome.begins_map)
    return fewPoints(outcome, s, options, "begin a map");
  if (diverged || (!outcome.updated && !outcome.begins_map)) return fewMatches(outcome, s, options);
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

ScanStatus statusOf(const ScanOutcome& outcome, const OdometryOptions& options)
{
  if (outcome.place == ScanOutcome::Place::OutsideGivenMap) return ScanStatus::Initializing;
  // The prediction bridges an outage, and its covariance says how well.
  if (outcome.after_outage && outcome.prediction_finite && !outcome.begins_map && !outcome.updated)
    return ScanStatus::PredictionOnly;
  if (isDiverged(outcome, options)) return ScanStatus::Diverged;
  if (outcome.begins_map) return ScanStatus::FirstScan;
  if (outcome.updated) return ScanStatus::Tracking;
  return outcome.place == ScanOutcome::Place::InMap ? ScanStatus::PredictionOnly
                                                    : ScanStatus::Diverged;
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
  const Mat3 position = result.filter.P.block<3, 3>(kPosition, kPosition);
  // A scan that matched nothing has constrained nothing.
  const bool constrained =
      outcome.begins_map || (outcome.updated && result.statistics.constraints.unconstrained == 0);
  context.lost_std = lost_.add(
      result.stamp_ns, constrained,
      std::sqrt(std::max(0.0, symmetricEigensystem(position).values[2])));
  context.max_mounting_error = maxMountingError(options_.calibration);
  context.max_gyro_scale_error = maxGyroScaleError(options_.calibration);
  context.max_range_scale_error = maxRangeScaleError(options_.calibration);
  result.health = healthOf(result, context);
  previous_ns_ = result.stamp_ns;
  if (result.status == ScanStatus::FirstScan)
    scans_until_dense_ = kSparseMapScans;
  else if (result.status == ScanStatus::Tracking)
    scans_until_dense_ = std::max(0, scans_until_dense_ - 1);
}

double LostPosition::add(std::int64_t stamp_ns, bool constrained, double std)
{
  if (!constrained) open_ns_ = stamp_ns;
  if (stamp_ns - open_ns_ >= kWellConstrained) known_std_ = std;
  return std::sqrt(std::max(0.0, std * std - known_std_ * known_std_));
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
