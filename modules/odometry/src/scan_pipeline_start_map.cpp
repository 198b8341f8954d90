// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "map_factory.h"
#include "scan_pipeline.h"
#include "start_in_map.h"

#include <mrpt/core/format.h>

#include <utility>

namespace fastlio
{
namespace
{
// From the whole uncertainty of the pose down: each pass looks nearer.
constexpr int kPasses = 4;
constexpr double kShrink = 0.25;  // of the variances of place and heading, per pass
}  // namespace

void ScanPipeline::useSavedMap(const SavedMap& saved)
{
  const bool ready = saved.planes && parameters_.map.type == MapType::Planes;
  map_ = makeSurfaceMap(parameters_, workers_);
  if (ready)
    map_ = std::make_unique<VoxelPlaneMap>(*saved.planes);
  else
    insertSavedPoints(saved.points, *map_);
  // Its errors are those of the world itself.
  insertions_ = map_->insertionCount();
  map_error_.recordInsertion(0, FoundingError{}, Pose{});
  start_in_map_ = saved.T_map_imu;
  map_is_given_ = true;
}

/** Looks for the scan around the prediction. */
UpdateResult ScanPipeline::findInMap(const FilterState& predicted)
{
  UpdateResult best;
  best.posterior = predicted;
  for (const Pose& candidate : posesAround(predicted.x.pose(), parameters_.initialization))
  {
    UpdateResult found = approach(predicted, candidate);
    if (found.updated && found.last.count > best.last.count) best = std::move(found);
  }
  share_in_map_ = static_cast<double>(best.last.count) /
                  static_cast<double>(std::max<std::size_t>(compensated_.points.size(), 1));
  if (share_in_map_ < parameters_.initialization.map_share)
  {
    UpdateResult none;
    none.posterior = predicted;
    none.last = best.last;
    return none;
  }
  // Once more, so that matches and constraints are those of the best.
  start_in_map_.reset();
  return updateWithScan(withUncertainPlace(
      standingAt(predicted, best.posterior.x.pose()), parameters_.initialization,
      std::pow(kShrink, kPasses)));
}

UpdateResult ScanPipeline::approach(const FilterState& predicted, const Pose& candidate)
{
  UpdateResult update;
  Pose at = candidate;
  double scale = 1.0;
  for (int pass = 0; pass < kPasses; ++pass)
  {
    scale *= kShrink;
    const FilterState from =
        withUncertainPlace(standingAt(predicted, at), parameters_.initialization, scale);
    update = update_.run(from, compensated_, *map_, edges_);
    if (!update.updated) break;
    at = update.posterior.x.pose();
  }
  return update;
}

void ScanPipeline::tellNotFound(ScanResult& result)
{
  result.status = ScanStatus::Initializing;
  last_update_ns_ = state_ns_;
  result.message = mrpt::format(
      "%.0f %% of the points match the given map around the initial pose, at least %.0f %% are "
      "needed (initialization.map_share); is the pose within initialization.pose_position_std "
      "(%.2f m) and pose_yaw_std of the true one?",
      100.0 * share_in_map_, 100.0 * parameters_.initialization.map_share,
      parameters_.initialization.pose_position_std);
}

}  // namespace fastlio
