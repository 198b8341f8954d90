// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "scan_pipeline.h"
#include <fastlio/math/stopwatch.h>

#include <cmath>

namespace fastlio
{
bool ScanPipeline::mayGrowMap(const ScanResult& result) const
{
  if (start_in_map_ || (map_is_given_ && !parameters_.map.update)) return false;
  if (rest_.restingTime() > parameters_.rest.map_time) return false;
  if (!evidence_good_) return false;  // what is lost must not spoil the map
  if (result.status == ScanStatus::Tracking || result.status == ScanStatus::FirstScan) return true;
  if (result.status == ScanStatus::Diverged) return false;
  // A young map has few planes: it must grow as long as the prediction knows where the scan is.
  const Matrix6 covariance = scanPoseCovariance(filter_, compensated_.compensation);
  const double position_variance = covariance.bottomRightCorner<3, 3>().diagonal().maxCoeff();
  return position_variance < std::pow(parameters_.map.max_insertion_std, 2);
}

void ScanPipeline::keepFields(const LidarScan& scan)
{
  const std::vector<std::uint32_t>& indices = selection_.indices;
  fields_.intensity.resize(indices.size());
  fields_.stamp_ns.resize(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    fields_.intensity[i] = scan.points.intensity[indices[i]];
    fields_.stamp_ns[i] = scan.stamp_ns + scan.points.time_offset_ns[indices[i]];
  }
}

void ScanPipeline::forgetPoints()
{
  world_.resize(0);
  fields_.intensity.clear();
  fields_.stamp_ns.clear();
}

void ScanPipeline::growMap(const LidarScan& scan, const FilterState& total)
{
  const Stopwatch watch;
  const Pose T_world_scan = scanPose(filter_.x, compensated_.compensation);
  world_.resize(compensated_.points.size());
  const auto transform = [&](std::size_t, std::size_t first, std::size_t last)
  { transformToWorld(compensated_.points, T_world_scan, first, last, world_); };
  workers_->forEachChunk(world_.size(), transform);
  FoundingError founding;
  founding.own = scanPoseCovariance(filter_, compensated_.compensation);
  founding.inherited = scanPoseCovariance(total, compensated_.compensation) - founding.own;
  if (state_ns_ <= young_map_.until_ns) founding.inherited += young_map_.founding_covariance;
  map_error_.recordInsertion(++insertions_, founding, T_world_scan);
  map_->insert(world_, T_world_scan * scan.T_imu_lidar.p);
  if (!map_is_given_) map_->removeOutside(filter_.x.p, parameters_.map.radius);
  edges_.growMap(T_world_scan);
  keepFields(scan);
  timings_.insert = watch.milliseconds();
}

}  // namespace fastlio
