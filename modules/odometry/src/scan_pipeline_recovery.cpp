// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "calibration_prior.h"
#include "map_factory.h"
#include "scan_pipeline.h"
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr int kPullInIterations = 15;
constexpr double kHeadingStep = 0.2617993877991494;  // [rad]; 15 deg
constexpr double kSigmas = 3.0;                      // of the heading
constexpr double kLooseInnovation = 2.0;             // of a scan that has just been pulled in
constexpr double kSureShare = 0.6;                   // so many matches: no need to look on

/** Standard deviation of the attitude about gravity [rad]. */
double headingStd(const FilterState& s)
{
  const Vec3 down = s.x.R.transpose() * s.x.g.normalized();
  const Mat3 P = s.P.block<3, 3>(kAttitude, kAttitude);
  return std::sqrt(std::max(0.0, down.dot(P * down)));
}

double innovation(const UpdateResult& update)
{
  return update.last.weighted_squares /
         static_cast<double>(std::max<std::size_t>(update.last.count, 1));
}

/** Many matches that agree. */
double score(const UpdateResult& update)
{
  if (!update.updated) return 0.0;
  return static_cast<double>(update.last.count) / std::max(1.0, innovation(update));
}

/** The state with another heading. */
FilterState turnedBy(double heading, const FilterState& s)
{
  FilterState turned = s;
  const Mat3 W = expSO3(-heading * s.x.g.normalized());
  turned.x.R = normalizeRotation(W * s.x.R);
  turned.x.v = W * s.x.v;
  return turned;
}
}  // namespace

void ScanPipeline::suspend()
{
  skipScan();
  rest_.reset();
  searching_ = false;
  state_ns_ = 0;
  pose_trusted_ = false;
}

void ScanPipeline::restart(
    const FilterState& start_state, std::int64_t stamp_ns, const YoungMap& young_map,
    const CarriedPose& carried)
{
  young_map_ = young_map;
  filter_ = withCalibrationOf(filter_, startInCarriedWorld(start_state, carried));
  constrainGravity();
  state_ns_ = stamp_ns;
  last_update_ns_ = stamp_ns;
  const double match_time = carried.new_map ? 0.0 : parameters_.recovery.match_time;
  recovery_end_ns_ = stamp_ns + toNanoseconds(match_time);
  lookForMap(true);
}

/** The carried pose may be far off: more iterations pull the scans in. */
void ScanPipeline::lookForMap(bool looking)
{
  if (looking && !recovering_)
    ordinary_iterations_ = {
        parameters_.measurement.association_iterations, parameters_.update.max_iterations};
  recovering_ = looking;
  parameters_.measurement.association_iterations =
      looking ? kPullInIterations : ordinary_iterations_.first;
  parameters_.update.max_iterations = looking ? kPullInIterations : ordinary_iterations_.second;
}

/** Tries headings around the predicted one, as far as it is uncertain. While the old map is looked
 * for, a few matches by chance are not it. */
UpdateResult ScanPipeline::findMap(const FilterState& predicted)
{
  const auto points = static_cast<double>(std::max<std::size_t>(compensated_.points.size(), 1));
  const double reach = std::min(kSigmas * headingStd(predicted), parameters_.recovery.max_heading);
  const int turns = map_->pointCount() == 0 ? 0 : static_cast<int>(std::ceil(reach / kHeadingStep));
  UpdateResult best = updateWithScan(predicted);
  double best_heading = 0.0, last_heading = 0.0;
  for (int i = 1; i <= 2 * turns; ++i)
  {
    if (score(best) > kSureShare * points) break;
    last_heading = kHeadingStep * ((i + 1) / 2) * (i % 2 == 0 ? 1.0 : -1.0);
    const UpdateResult update = updateWithScan(turnedBy(last_heading, predicted));
    if (score(update) <= score(best)) continue;
    best = update;
    best_heading = last_heading;
  }
  // The matches of the best one are needed.
  if (best_heading != last_heading) best = updateWithScan(turnedBy(best_heading, predicted));
  const double found = parameters_.recovery.min_share * points;
  const bool agrees = innovation(best) <= kLooseInnovation * parameters_.health.max_innovation;
  if (best.updated && static_cast<double>(best.last.count) >= found && agrees) return best;
  UpdateResult refused;
  refused.posterior = predicted;
  refused.iterations = best.iterations;
  refused.last = best.last;
  return refused;
}

void ScanPipeline::judgeRecovery(ScanResult& result)
{
  if (result.status == ScanStatus::Tracking)
  {
    lookForMap(false);
    result.message = mrpt::format(
        "the map is found again after a new start, %zu of %zu points match it",
        result.statistics.points_effective, compensated_.points.size());
  }
  else if (result.status == ScanStatus::FirstScan)
  {
    lookForMap(false);
    const double position_std =
        std::sqrt(filter_.P.block<3, 3>(kPosition, kPosition).diagonal().maxCoeff());
    result.message = mrpt::format(
        "a new map is begun at the pose that was carried over, which is uncertain by %.2f m",
        position_std);
  }
  else
  {
    result.status = ScanStatus::Diverged;
    result.message = "a new start, looking for the map: " + result.message;
  }
}

void ScanPipeline::beginNewMap()
{
  if (map_is_given_) return;  // the world is that of the map
  if (compensated_.points.size() <
      static_cast<std::size_t>(parameters_.measurement.min_effective_points))
    return;
  map_ = makeSurfaceMap(parameters_, workers_);
  edges_ = EdgeStage(parameters_);
  map_error_ = {};
  insertions_ = 0;
  searching_ = false;
  usual_share_ = 0.0;
  shares_ = 0;
}

}  // namespace fastlio
