// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "edge_stage.h"

namespace fastlio
{
namespace
{
EdgeMapOptions edgeMapOptions(const Parameters& parameters)
{
  EdgeMapOptions options;
  options.min_spacing = parameters.features.edge_spacing;
  options.max_neighbor_distance = parameters.features.max_edge_distance;
  options.max_line_distance = parameters.features.max_edge_scatter;
  options.point_noise = parameters.measurement.range_noise;
  return options;
}
}  // namespace

EdgeStage::EdgeStage(const Parameters& parameters)
    : radius_(parameters.map.radius), map_(edgeMapOptions(parameters))
{
}

void EdgeStage::associate(const Pose& T_world_scan)
{
  world_.resize(points_.size());
  matches_.resize(points_.size());
  transformToWorld(points_, T_world_scan, 0, points_.size(), world_);
  map_.match(world_, 0, points_.size(), matches_);
}

InformationSums EdgeStage::sums(const Pose& T_world_scan, const ResidualModel& model) const
{
  return accumulateLines(T_world_scan, points_, matches_, model, 0, points_.size());
}

void EdgeStage::stack(
    const Pose& T_world_scan, const ResidualModel& model, StackedMeasurements& stacked) const
{
  stackLines(T_world_scan, points_, matches_, model, stacked);
}

void EdgeStage::growMap(const Pose& T_world_scan)
{
  world_.resize(points_.size());
  transformToWorld(points_, T_world_scan, 0, points_.size(), world_);
  map_.insert(world_);
  map_.removeOutside(T_world_scan.p, radius_);
}

}  // namespace fastlio
