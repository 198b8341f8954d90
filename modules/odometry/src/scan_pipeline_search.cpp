// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "scan_pipeline.h"

#include <mrpt/core/format.h>

#include <algorithm>

namespace fastlio
{
namespace
{
// Residuals that are so many times the noise come of a wrong pose. Clocks that are apart and noise
// that is set too small make a few times the noise: trouble, but a match.
constexpr double kWrongPoseInnovation = 10.0;
// A pose that is found has to match this part of what scans matched before the search.
constexpr double kUsualPart = 0.5;
}  // namespace

/** Residuals along a degenerate direction stay large by design: nothing corrects them. */
bool ScanPipeline::isConvincing(const UpdateResult& update) const
{
  if (update_.constraints().unconstrained > 0) return true;
  const double matched = static_cast<double>(std::max<std::size_t>(update.last.count, 1));
  const auto points = static_cast<double>(std::max<std::size_t>(compensated_.points.size(), 1));
  return update.last.weighted_squares / matched <= kWrongPoseInnovation &&
         matched / points >= parameters_.health.min_share * usual_share_;
}

/** A map of few scans says little: there, ordinary matching has to do. A map that was grown from a
 * wrong pose would agree with it ever after, so a match that does not convince is no match. */
UpdateResult ScanPipeline::matchOrSearch(const FilterState& predicted)
{
  search_ = {};
  const bool map_can_tell = parameters_.recovery.enabled && insertions_ >= kYoungMapInsertions;
  if (map_can_tell && needsPoseSearch(predicted)) searching_ = true;
  if (searching_) return searchInPrediction(predicted);
  const UpdateResult update = updateWithScan(predicted);
  if (!map_can_tell || !update.updated || isConvincing(update)) return update;
  searching_ = true;
  return searchInPrediction(predicted);
}

UpdateResult ScanPipeline::searchInPrediction(const FilterState& predicted)
{
  const MeasurementOptions measurement = parameters_.measurement;
  const IterationLimits limits = parameters_.update;
  const auto match = [&](const FilterState& start, const CompensatedScan& scan, int iterations)
  {
    parameters_.measurement.association_iterations = iterations;
    parameters_.update.max_iterations = iterations;
    return update_.run(start, scan, *map_, edges_);
  };
  PoseSearchLimits wanted;
  wanted.min_inlier_ratio = std::max(parameters_.recovery.min_share, kUsualPart * usual_share_);
  wanted.max_innovation = parameters_.health.max_innovation;
  search_ = searchPose(predicted, compensated_, wanted, match);
  parameters_.measurement = measurement;
  parameters_.update = limits;
  UpdateResult refused;
  refused.posterior = predicted;
  if (!search_.accepted) return refused;
  UpdateResult update = updateWithScan(correctedByPose(predicted, search_.best->T_world_imu));
  if (!update.updated || !isConvincing(update))
  {
    refused.last = update.last;
    search_.accepted = false;
    return refused;
  }
  searching_ = false;
  return update;
}

void ScanPipeline::reportSearch(ScanResult& result) const
{
  if (search_.candidates == 0) return;
  if (!searching_)
  {
    result.message = mrpt::format(
        "the pose is found again in the map: %.0f %% of the points match, %zu places were tried",
        100.0 * search_.best->inlier_ratio, search_.candidates);
    return;
  }
  result.message += mrpt::format(
      "; %zu places within the prediction's uncertainty were tried, the best one matches %.0f %% "
      "of the points with a mean z^2/r of %.1f (its rival has %.0f %% of its score)",
      search_.candidates, search_.best ? 100.0 * search_.best->inlier_ratio : 0.0,
      search_.best ? search_.best->innovation : 0.0,
      search_.best && search_.best->score > 0.0 ? 100.0 * search_.rival_score / search_.best->score
                                                : 0.0);
}

}  // namespace fastlio
