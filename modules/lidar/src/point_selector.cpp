// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/point_selector.h>

#include <algorithm>
#include <limits>

namespace fastlio
{
namespace
{
// RMS range beyond which more points are used: rooms and streets end before it [m].
constexpr float kWideRange = 20.0F;
// Enough edges to hold a pose; more of them are the noise of foliage.
constexpr std::size_t kTargetEdges = 300;

DownsamplingLimits downsamplingLimits(const LidarOptions& lidar, const DownsamplingOptions& p)
{
  return {
      static_cast<float>(lidar.min_range), static_cast<float>(lidar.max_range),
      static_cast<std::size_t>(p.target_points), kWideRange,
      static_cast<std::size_t>(p.wide_points)};
}

FeatureLimits featureLimits(const LidarOptions& lidar, const FeatureOptions& p)
{
  FeatureLimits limits;
  limits.min_range = static_cast<float>(lidar.min_range);
  limits.max_range = static_cast<float>(lidar.max_range);
  limits.line_order = p.scan_lines;
  limits.half_width = p.half_width;
  limits.max_beam_gap = p.max_beam_gap;
  return limits;
}

}  // namespace

PointSelector::PointSelector(
    const LidarOptions& lidar, const DownsamplingOptions& downsampling,
    const FeatureOptions& features, const std::shared_ptr<const Workers>& workers)
    : mode_(features.mode),
      downsampling_limits_(downsamplingLimits(lidar, downsampling)),
      feature_limits_(featureLimits(lidar, features)),
      surface_downsampler_(workers),
      edge_downsampler_(workers)
{
}

void PointSelector::thin(
    const PointColumns& points, const std::vector<std::uint32_t>& candidates,
    DownsamplingLimits limits, Downsampler& downsampler, std::vector<std::uint32_t>& chosen)
{
  // The candidates have passed the range gates.
  limits.min_range = 0.0F;
  limits.max_range = std::numeric_limits<float>::max();
  candidates_.clear();
  for (const std::uint32_t i : candidates)
    candidates_.push_back(points.x[i], points.y[i], points.z[i], 0.0F, 0, points.ring[i]);
  downsampler.select(candidates_, limits, thinned_);
  chosen.clear();
  for (const std::uint32_t k : thinned_.indices)
    chosen.push_back(candidates[k]);
}

void PointSelector::select(
    const PointColumns& points, std::size_t at_least, ScanSelection& surfaces,
    std::vector<std::uint32_t>& edges)
{
  DownsamplingLimits limits = downsampling_limits_;  // a target of 0 means all points
  if (limits.target_points > 0) limits.target_points = std::max(limits.target_points, at_least);
  edges.clear();
  if (mode_ == FeatureMode::None)
  {
    surface_downsampler_.select(points, limits, surfaces);
    return;
  }
  extractor_.extract(points, feature_limits_, features_);
  thin(points, features_.planar, limits, surface_downsampler_, surfaces.indices);
  limits.target_points = limits.wide_points = kTargetEdges;
  if (mode_ == FeatureMode::PlanarAndEdge)
    thin(points, features_.edges, limits, edge_downsampler_, edges);
  surfaces.dropped_invalid = features_.dropped_invalid;
  surfaces.dropped_near = features_.dropped_near;
  surfaces.dropped_far = features_.dropped_far;
}

}  // namespace fastlio
