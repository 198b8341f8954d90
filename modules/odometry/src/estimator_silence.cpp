// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What the estimator does when a sensor was silent: the IMU, both at once, or the LiDAR for long.

#include "estimator.h"
#include "gap_distortion.h"
#include <fastlio/matching/match_evidence.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace fastlio
{
namespace
{
// A scan where it belongs has nearly as many inliers as the scans before it.
constexpr double kNearlyUsual = 0.7;
constexpr double kMatchesAtAll = 0.3;  // of it, somewhere near its place
constexpr double kBetter = 1.05;       // one explanation than another
// Where the two lead to different places: a wrong place may look like the right one. By trial:
// losses of 0.45 s reach 1.08, steps of the clock begin at 1.4.
constexpr double kFarBetter = 1.25;
constexpr double kSamePlace = 0.2;  // [m]

// A map that begins with so wrong a tilt contradicts gravity by a third of a metre per square
// second ever after [rad].
constexpr double kKnownTilt = 0.03;

constexpr int kGapPasses = 5;
constexpr double kSettled = 1e-4;  // of the rotation between passes [rad]
// A scan that was followed is distorted about as much as scans are that just can be matched [m].
constexpr double kFollowedDistortion = 0.9 * kMostDistortion;
// The rate from middle to middle is that at the scan's begin. When it changes by d in the time T of
// a scan, it is 3/4 d more on average from the middle to the end, which takes T / 2.
constexpr double kBeyondMiddle = 0.375;

double tiltStd(const FilterState& state)
{
  const Vec3 down = state.x.down();
  const Mat3 P = state.P.block<3, 3>(kAttitude, kAttitude);
  return std::sqrt(std::max(0.0, P.trace() - down.dot(P * down)));
}
}  // namespace

/** Where a sensor was silent, the scan says how the platform moved meanwhile. */
void Estimator::explainSilence(
    const LidarScan& scan, std::int64_t end_ns, const ImuBuffer& imu, ScanPrediction& predicted)
{
  const auto* tracking = std::get_if<Tracking>(&mode_);
  if (tracking == nullptr || tracking->searching || map_.isSparse()) return;
  if (predicted.silent_ns > 0)
    admitClockStep(scan, end_ns, imu, predicted);
  else if (options_.recovery.enabled && predicted.gap_rotation_std > 0.0)
    followThroughGap(scan, end_ns, imu, predicted);
}

/** A clock that was set ahead leaves the scan where it would be without the silence, to
 * centimetres. It is believed when that explains the scan better than the motion that bridges the
 * silence. */
void Estimator::admitClockStep(
    const LidarScan& scan, std::int64_t end_ns, const ImuBuffer& imu, ScanPrediction& predicted)
{
  ScanPrediction stepped = predictor_.afterClockStep(state_, end_ns, imu, predicted);
  if (!stepped.finite) return;
  struct Outcome
  {
    double score = 0.0;  // the inlier ratio, as a part of the usual one
    Vec3 place;
  };
  const auto outcomeOf = [&](const ScanPrediction& explanation) -> Outcome
  {
    const DeskewedScan& deskewed = deskew(scan, end_ns, explanation.state.x);
    const MatchResult match = pullIn({scan, end_ns, deskewed, explanation, state_.filter.x});
    const Vec3 place = match.update.posterior.x.p;
    if (!match.update.updated || !isConvincing(match, deskewed, map_)) return {0.0, place};
    const double ratio = inlierRatio(match.update.last.count, deskewed.surfaces.size());
    return {
        ratio / map_.usualInlierRatio() / std::max(1.0, normalizedInnovation(match.update)), place};
  };
  const Outcome with_silence = outcomeOf(predicted), without = outcomeOf(stepped);
  const bool same_place = (with_silence.place - without.place).norm() < kSamePlace;
  // Where the bridged motion leads nowhere, nothing is compared.
  const bool compared = with_silence.score > kMatchesAtAll && without.score > kNearlyUsual;
  if (compared && without.score > (same_place ? kBetter : kFarBetter) * with_silence.score)
    predicted = std::move(stepped);
}

/** Without inertial samples the scans show how the platform turns, as in an odometry of the LiDAR
 * alone: the rotation that a match finds deskews the scan for the next match. A wrong rate turns a
 * scan about its middle, so its end is off by half of what the rate makes of it. The rate is that
 * from the middle of the scan before to the middle of this one: taken from end to end, it would
 * swing to and fro. */
void Estimator::followThroughGap(
    const LidarScan& scan, std::int64_t end_ns, const ImuBuffer& imu, ScanPrediction& predicted)
{
  const double distortion = deskewStd(deskew(scan, end_ns, predicted.state.x), predicted);
  const double missing_s = secondsInGaps(imu.inflations(), state_.stamp_ns, end_ns);
  // A gap may lie in the part of the scan that the scan before has, too.
  if (distortion <= kMostDistortion || missing_s == 0.0) return;
  // How far the motion departs from that around the gap grows with the time.
  const double grown = std::min(1.0, missing_s / options_.imu.max_gap);
  const double expected_std =
      grown * rotationStdInGaps(imu.inflations(), state_.stamp_ns, end_ns) / missing_s;
  ScanPrediction followed = predicted;
  followed.gap_rotation_std = 0.0;  // the scan is taken at its word
  Vec3 change = Vec3::Zero();       // of the rate since the scan before
  std::optional<Vec3> fitting;      // change of the last pass that fits
  for (int pass = 0; pass < kGapPasses && followed.finite; ++pass)
  {
    const DeskewedScan& deskewed = deskew(scan, end_ns, followed.state.x);
    const MatchResult match = pullIn({scan, end_ns, deskewed, followed, state_.filter.x});
    if (!match.update.updated || !isConvincing(match, deskewed, map_)) break;
    const bool fits = matchesAsFound(match, deskewed, map_);
    const Vec3 turn = logSO3(followed.state.x.R.transpose() * match.update.posterior.x.R);
    const Vec3 step = turn / missing_s - 0.5 * change;
    change += step;
    followed = predictor_.withRateInGap(state_, end_ns, imu, step, followed);
    if (fits) fitting = change;
    if (step.norm() * missing_s < kSettled) break;
  }
  const ScanPrediction last = predictor_.withRateInGap(
      state_, end_ns, imu, fitting.value_or(Vec3::Zero()) - change, predicted);
  if (!fitting || !last.finite) return;
  predicted = last;
  predicted.gap_rotation_std *= kFollowedDistortion / distortion;
  RateInGap& rate = predictor_.rateInGap();
  rate.add(*fitting);
  predicted.end_rotation_std = kBeyondMiddle * rate.changeStd(expected_std) * missing_s;
}

/** The inertial data were well, so nothing is re-initialised: where the map does not show the
 * place, a new one begins at the predicted pose. */
MapSearchResult Estimator::searchAfterOutage(const Work& work)
{
  auto& tracking = std::get<Tracking>(mode_);
  OutageSearch& outage = *tracking.outage;
  const DeskewedScan& scan = work.deskewed;
  const bool knew = outage.knowsVelocity();
  const FilterState state = outage.withVelocity(scan, work.predicted.state, work.end_ns, matcher_);
  if (outage.knowsVelocity() && !knew) deskew(work.scan, work.end_ns, state.x);
  const MapSearch search(options_, matcher_, scan, map_);
  MapSearchResult result = outage.measuresVelocity(work.end_ns)
                               ? search.postponed(state)
                               : searchOrWait(scan, state, work.end_ns);
  const bool over = result.found || outage.isOver(work.end_ns);
  if (over && !result.found && outage.knowsVelocity() && tiltStd(state) < kKnownTilt)
  {
    const FilterState from = beginNewMap(scan, state);
    if (map_.empty()) result = search.postponed(from);
  }
  tracking.lost = over && !result.found && tiltStd(state) >= kKnownTilt;
  tracking.searching = !result.found && !map_.empty();
  result.after_outage = true;
  result.expects_new_view = outage.expectsNewView();
  if (over) tracking.outage.reset();
  return result;
}

/** A given map stays, as the world is that of the map. \return the state, as uncertain as its pose
 * is in the world: the errors of the old map are a part of that, as the new map begins at this
 * pose.
 */
FilterState Estimator::beginNewMap(const DeskewedScan& scan, const FilterState& predicted)
{
  FilterState state = predicted;
  if (map_.isGiven() || !hasEnoughPoints(scan)) return state;
  const CalibrationEstimate& calibration = calibration_.estimate();
  state.P += map_.error().addition() + map_.calibrationError().addition(calibration.second_moment) /
                                           calibration.innovation_scale;
  // The error of this pose is that of the new map. What scans will say about the way from here on
  // contains nothing about it, and it contains nothing about the motion.
  state = withIndependentPosition(state, Mat3::Identity());
  useMap(LocalMap(options_, workers_));
  map_.beginAt(scanPoseCovariance(state, scan.compensation).diagonal().tail<3>());
  return state;
}

}  // namespace fastlio
