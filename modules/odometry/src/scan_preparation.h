// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_preparation.h From a raw scan to deskewed points (eq. 9-10). */
#pragma once

#include <fastlio/filter/backward_propagation.h>
#include <fastlio/imu/rest_detector.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/interface/scan_result.h>
#include <fastlio/lidar/deskew.h>
#include <fastlio/lidar/point_selector.h>
#include <fastlio/matching/match_result.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace fastlio
{
/** Downsamples and deskews; keeps the storage between scans. */
class ScanPreparation
{
 public:
  ScanPreparation(const OdometryOptions& options, const std::shared_ptr<const Workers>& workers);

  /** \param at_least takes the place of downsampling.target_points where that is smaller */
  void downsample(const LidarScan& scan, std::size_t at_least);
  /** The downsampled points at the scan's end, valid until the next call.
   * \param predicted the state there \param inputs the inertial samples that led to it */
  [[nodiscard]] const DeskewedScan& deskew(
      const LidarScan& scan, std::int64_t end_ns, const NavState& predicted,
      const std::vector<ImuSample>& inputs, const BeamCorrections& beams);

  /** Counts of the downsampled scan. */
  void describe(const LidarScan& scan, ScanStatistics& statistics) const;
  /** Intensity and time of the surface points. */
  void fieldsOf(const LidarScan& scan, RegisteredFields& fields) const;

 private:
  bool deskew_;
  double gyro_noise_density_;
  PointSelector selector_;
  Deskewer deskewer_;
  ScanSelection selection_;
  std::vector<std::uint32_t> edge_indices_;
  std::vector<MotionKnot> knots_;
  DeskewedScan deskewed_;
};

}  // namespace fastlio
