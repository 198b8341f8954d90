// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_selector.h Which points of a scan take part: an even thinning of all points, or of
 * features (section III-B of the paper). */
#pragma once

#include <fastlio/lidar/downsampling.h>
#include <fastlio/lidar/feature_extraction.h>
#include <fastlio/lidar/lidar_options.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace fastlio
{
/** Chooses points by features.mode. */
class PointSelector
{
 public:
  PointSelector(
      const LidarOptions& lidar, const DownsamplingOptions& downsampling,
      const FeatureOptions& features, const std::shared_ptr<const Workers>& workers);

  /** \param points the raw scan
   * \param at_least takes the place of downsampling.target_points where that is smaller
   * \param surfaces points to be matched with planes, about downsampling.target_points of them,
   * evenly spread: of all points, or of the planar features
   * \param edges points to be matched with lines, about 300; none but in the mode
   * `planar_and_edge` */
  void select(
      const PointColumns& points, std::size_t at_least, ScanSelection& surfaces,
      std::vector<std::uint32_t>& edges);

  /** Of Downsampler. */
  [[nodiscard]] bool seesSparseLines() const { return surface_downsampler_.seesSparseLines(); }

 private:
  void thin(
      const PointColumns& points, const std::vector<std::uint32_t>& candidates,
      DownsamplingLimits limits, Downsampler& downsampler, std::vector<std::uint32_t>& chosen);

  FeatureMode mode_;
  DownsamplingLimits downsampling_limits_;
  FeatureLimits feature_limits_;
  FeatureExtractor extractor_;
  Downsampler surface_downsampler_, edge_downsampler_;
  // Reused between scans.
  ScanFeatures features_;
  PointColumns candidates_;
  ScanSelection thinned_;
};

}  // namespace fastlio
