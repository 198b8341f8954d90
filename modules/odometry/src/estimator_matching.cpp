// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// How the estimator matches a scan in each of its modes.

#include "estimator.h"
#include <fastlio/math/stopwatch.h>
#include <fastlio/math/time.h>

#include <utility>

namespace fastlio
{
MapSearchResult Estimator::matchWithMap(
    const DeskewedScan& scan, const ScanPrediction& predicted, std::int64_t end_ns)
{
  const Stopwatch watch;
  const auto timed = [&](MapSearchResult result)
  {
    timings_.associate = result.match.association_ms;
    timings_.update = watch.milliseconds() - timings_.associate;
    return result;
  };
  if (auto* entering = std::get_if<EnteringMap>(&mode_))
  {
    MapSearchResult search =
        MapSearch(options_, matcher_, scan, map_).aroundGivenPose(predicted.state);
    if (search.found) mode_ = Tracking{std::move(entering->run)};
    return timed(std::move(search));
  }
  if (const auto* relocalizing = std::get_if<Relocalizing>(&mode_))
  {
    if (end_ns > relocalizing->give_up_ns) beginNewMap(scan);
    return timed(MapSearch(options_, matcher_, scan, map_).aroundCarriedPose(predicted.state));
  }
  return timed(trackOrSearch(scan, predicted));
}

/** A map of few scans says little: there, ordinary matching has to do. A map that was grown from a
 * wrong pose would agree with it ever after, so a match that does not convince is no match. */
MapSearchResult Estimator::trackOrSearch(const DeskewedScan& scan, const ScanPrediction& predicted)
{
  auto& tracking = std::get<Tracking>(mode_);
  const bool map_is_informative = options_.recovery.enabled && !map_.isSparse();
  if (map_is_informative && needsPoseSearch(predicted.state, predicted.blind_s))
    tracking.searching = true;
  if (!tracking.searching)
  {
    const bool pull_in = tracking.run.motion_window && tracking.run.motion_window->pull_in;
    MatchResult match = matcher_.match(
        scan, predicted.state, map_.matched(),
        pull_in ? pullInMatching(options_) : ordinaryMatching(options_));
    const bool good = !match.update.updated || isConvincing(match, scan, map_);
    if (!map_is_informative || good) return {std::move(match), true, std::nullopt};
  }
  MapSearchResult search =
      MapSearch(options_, matcher_, scan, map_).aroundPrediction(predicted.state);
  tracking.searching = !search.found;
  return search;
}

/** A given map stays, as the world is that of the map. */
void Estimator::beginNewMap(const DeskewedScan& scan)
{
  if (map_.isGiven() || scan.surfaces.size() < kMinEffectivePoints) return;
  map_ = LocalMap(options_, workers_);
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
  if (matched.poses || run().motion_window || inflated)
    agreement_.restart();
  else if (match.update.updated && match.constraints.unconstrained == 0)
    agreement_.add(
        work.before, work.predicted.blind_s, work.predicted.state, match.update.posterior,
        work.explained);
  statistics.motion_innovation = agreement_.innovation();
  statistics.unexplained_motion_innovation = agreement_.unexplainedInnovation();
  statistics.mounting_error = agreement_.mountingError();
  statistics.gyro_scale = agreement_.gyroScale();
}

}  // namespace fastlio
