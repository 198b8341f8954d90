// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// How the estimator matches a scan in each of its modes.

#include "estimator.h"
#include "gap_distortion.h"
#include <fastlio/matching/match_evidence.h>
#include <fastlio/math/stopwatch.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace fastlio
{
namespace
{
// Of the recording, for each place that was tried in vain [ns]: three thousand of them are tried
// five times a second.
constexpr std::int64_t kPausePerCandidate = 60'000;

// Of measurement.min_signal_to_noise. Found by trial: with 0.1, 0.3 or 0.6 a start in an open area
// or in fast rotation fails.
constexpr double kStartSignalToNoise = 0.2;

// How far a position that was lost along open directions may be off, as a standard deviation: the
// gate of the ordinary match has planes that are nearer, and the map's largest voxels end there.
constexpr double kLeastLost = 0.1, kMostLost = 2.0;  // [m]
// Fewer points more than in the ordinary match may be those of planes that happen to lie there, as
// the next step of a staircase does.
constexpr double kPlaneFoundAgain = 0.05;  // of all points

// A velocity that is off by so much shears a scan of 0.1 s more than its planes are thick [m/s].
constexpr double kShearingVelocity = 0.3;

double velocityStd(const FilterState& predicted)
{
  return std::sqrt(predicted.P.diagonal().segment<3>(kVelocity).maxCoeff());
}

bool hasOpenDirection(const MatchResult& match)
{
  return match.constraints.unconstrained > 0;
}
}  // namespace

MapSearchResult Estimator::matchWithMap(const Work& work)
{
  const Stopwatch watch;
  const DeskewedScan& scan = work.deskewed;
  const FilterState& predicted = work.predicted.state;
  const auto timed = [&](MapSearchResult result)
  {
    timings_.associate = result.match.association_ms;
    timings_.update = watch.milliseconds() - timings_.associate;
    return result;
  };
  if (auto* entering = std::get_if<EnteringMap>(&mode_))
  {
    MapSearchResult search = MapSearch(options_, matcher_, scan, map_).aroundGivenPose(predicted);
    if (search.found) mode_ = Tracking{std::move(entering->run), false, nullptr};
    return timed(std::move(search));
  }
  if (const auto* relocalizing = std::get_if<Relocalizing>(&mode_))
  {
    const FilterState from =
        work.end_ns > relocalizing->give_up_ns ? beginNewMap(scan, predicted) : predicted;
    return timed(MapSearch(options_, matcher_, scan, map_).aroundCarriedPose(from));
  }
  return timed(trackOrSearch(work));
}

/** A search without hope takes many times as long as a scan. The next one waits, so that a live
 * sensor is not left behind for long. */
MapSearchResult Estimator::searchOrWait(
    const DeskewedScan& scan, const FilterState& predicted, std::int64_t end_ns)
{
  SearchPause& pause = run().search_pause;
  const MapSearch search(options_, matcher_, scan, map_);
  if (pause.last && end_ns < pause.until_ns)
  {
    MapSearchResult waits = search.postponed(predicted);
    waits.poses = pause.last;
    return waits;
  }
  MapSearchResult result = search.aroundPrediction(predicted);
  pause = {};
  if (!result.found && result.poses)
    pause = {
        end_ns + kPausePerCandidate * static_cast<std::int64_t>(result.poses->candidates),
        result.poses};
  return result;
}

/** A map of few scans says little: there, ordinary matching has to do, but for a scan that fits it
 * nowhere. A map that was grown from a wrong pose would agree with it ever after, so a match that
 * does not convince is no match. */
MapSearchResult Estimator::trackOrSearch(const Work& work)
{
  auto& tracking = std::get<Tracking>(mode_);
  const DeskewedScan& scan = work.deskewed;
  const FilterState& predicted = work.predicted.state;
  const bool map_is_informative = options_.recovery.enabled && !map_.isSparse();
  const bool seen_again = hasEnoughPoints(scan);
  if (map_is_informative && seen_again && needsPoseSearch(predicted, work.predicted.unseen_s))
  {
    tracking.searching = true;
    tracking.outage = std::make_unique<OutageSearch>(
        options_, workers_, predicted, work.end_ns, work.predicted.unseen_s);
  }
  const auto withoutMatch = [&]() -> MapSearchResult
  {
    return {
        MapSearch(options_, matcher_, scan, map_).postponed(predicted).match, true, std::nullopt};
  };
  if (!tracking.searching && map_is_informative &&
      deskewStd(scan, work.predicted) > kMostDistortion)
    return withoutMatch();
  if (!tracking.searching)
  {
    MatchResult match = matchPrediction(work);
    const bool starting = tracking.run.startingAt(work.end_ns), open = hasOpenDirection(match);
    const bool uncertain = !starting && needsPullIn(predicted, open);
    if (uncertain)
      match = pullIn(work);
    else if (open && !starting)
      match = alongOpenDirections(std::move(match), work);
    // A scan that a gap has distorted matches worse, and hardly moves the state.
    const bool found = !uncertain || (match.model.weight < 1.0 ? fitsAsDistorted(match, scan)
                                                               : matchesAsFound(match, scan, map_));
    const bool turns_away = !uncertain && calibration_.expectedInnovation() == 1.0 &&
                            fitsAllThatIsMapped(match, scan, map_);
    const bool good = match.update.updated
                          ? found && (turns_away || isConvincing(match, scan, map_))
                          : !isContradicted(match, scan, map_);
    const bool fits_nowhere = options_.recovery.enabled && !tracking.run.isTrial() &&
                              normalizedInnovation(match.update) > kWrongPoseInnovation;
    if (map_is_informative ? good : !fits_nowhere) return {std::move(match), true, std::nullopt};
    if (uncertain) deskew(work.scan, work.end_ns, predicted.x);
    if (!map_is_informative) return withoutMatch();
    if (seen_again && velocityStd(predicted) > kShearingVelocity)
      tracking.outage = std::make_unique<OutageSearch>(
          options_, workers_, predicted, work.end_ns, work.predicted.unseen_s);
  }
  if (tracking.outage) return searchAfterOutage(work);
  MapSearchResult search = searchOrWait(scan, predicted, work.end_ns);
  if (search.found)  // once more, deskewed with the motion that it found
  {
    deskew(work.scan, work.end_ns, search.match.update.posterior.x);
    search = MapSearch(options_, matcher_, scan, map_).aroundPrediction(predicted);
  }
  tracking.searching = !search.found;
  return search;
}

/** Where scans contradict their predictions more than these admit, as after a step of the inertial
 * sensor, the next prediction will be as wrong. The gate would lose the planes that show it, the
 * ground first, and the pose would follow the sensor for ever. */
MatchResult Estimator::matchPrediction(const Work& work)
{
  const FilterRun& run = this->run();
  const bool pull_in = run.motion_window && run.motion_window->pull_in;
  MatchOptions how = pull_in ? pullInMatching(options_) : ordinaryMatching(options_);
  // Only these scans can tell the velocity of a start in motion: no direction is left out lightly.
  const bool settles = run.settlingAt(work.end_ns);
  if (settles)
  {
    how.measurement.min_signal_to_noise *= kStartSignalToNoise;
    how.at_start = true;
    // A pass begins far off, where a wider gate would take one post of a fence for the next.
    if (!run.isTrial()) how.map_attitude_variance = run.motion_window->mapAttitudeVariance();
  }
  how.deskew_std = deskewStd(work.deskewed, work.predicted);
  how.gate_factor = settles ? 1.0 : calibration_.expectedInnovation();
  const auto match = [&]
  { return matcher_.match(work.deskewed, work.predicted.state, map_.matched(), how); };
  MatchResult result = match();
  const auto fits = [&]
  {
    return normalizedInnovation(result.update) <= kMaxInnovation &&
           isConvincing(result, work.deskewed, map_);
  };
  if (how.gate_factor > 1.0 && !fits())
  {
    how.gate_factor = 1.0;  // the wider gate has let in what does not belong to the planes
    result = match();
  }
  return result;
}

/** Where scans leave a direction open, the position drifts along it: planes that show it again then
 * lie outside the gate of the filter's own covariance, would not match ever after, and the
 * direction would stay open. They are looked for as far as the whole covariance reaches. */
MatchResult Estimator::alongOpenDirections(MatchResult match, const Work& work)
{
  FilterState start = work.predicted.state;
  const Mat3 systematic =  // the errors of the map have been propagated already
      systematicCovariance({start, ErrorTransition()}).block<3, 3>(kPosition, kPosition);
  const double lost = std::sqrt(std::max(0.0, systematic.trace()));
  if (!(lost > kLeastLost && lost < kMostLost)) return match;
  start.P.block<3, 3>(kPosition, kPosition) += systematic;
  MatchResult again = pullIn(work, start);
  const double more =
      static_cast<double>(again.update.last.count) - static_cast<double>(match.update.last.count);
  const auto points = static_cast<double>(work.deskewed.surfaces.size());
  const bool found = again.constraints.unconstrained < match.constraints.unconstrained &&
                     more > kPlaneFoundAgain * points && matchesAsFound(again, work.deskewed, map_);
  if (found) return again;
  deskew(work.scan, work.end_ns, work.predicted.state.x);
  return matchPrediction(work);  // the matcher keeps the matches of the latest one only
}

/** Where the prediction is uncertain, so is the motion that the points were deskewed with. They are
 * deskewed again with the motion that a first match finds: otherwise a wrong velocity shears the
 * scan, the sheared scan confirms the velocity, and the map drifts along with both. */
MatchResult Estimator::pullIn(const Work& work, const std::optional<FilterState>& start)
{
  MatchOptions first = pullInMatching(options_), second = ordinaryMatching(options_);
  first.start = start;
  first.measurement.min_signal_to_noise = 0.0;  // it may be wrong along what it does not see
  first.deskew_std = second.deskew_std = deskewStd(work.deskewed, work.predicted);
  const FilterState& predicted = work.predicted.state;
  MatchResult near = matcher_.match(work.deskewed, predicted, map_.matched(), first);
  if (!near.update.updated) return near;
  second.start = near.update.posterior;
  deskew(work.scan, work.end_ns, second.start->x);
  return matcher_.match(work.deskewed, predicted, map_.matched(), second);
}

/** Along a degenerate direction the prediction is not corrected, so it cannot be compared; nor
 * where inertial data are missing or their noise is inflated. */
void Estimator::compareMotion(
    const MapSearchResult& matched, const Work& work, const ImuBuffer& imu,
    ScanStatistics& statistics)
{
  if (map_.isGiven()) return;
  const MatchResult& match = matched.match;
  const std::int64_t since_ns = state_.stamp_ns - toNanoseconds(work.predicted.blind_s);
  const bool inflated = inflatedRatio(imu.inflations(), since_ns, state_.stamp_ns) > 0.0;
  if (matched.poses || run().settlingAt(state_.stamp_ns) || inflated)
    agreement_.restart();
  else if (match.update.updated && match.constraints.unconstrained == 0)
    agreement_.add(
        work.before, work.predicted.blind_s, work.predicted.state, match.update, work.explained);
  statistics.motion_innovation = agreement_.innovation();
  statistics.unexplained_motion_innovation = agreement_.unexplainedInnovation();
  statistics.mounting_error = agreement_.mountingError();
  statistics.gyro_scale = agreement_.gyroScale();
  statistics.range_scale = agreement_.rangeScale();
}

}  // namespace fastlio
