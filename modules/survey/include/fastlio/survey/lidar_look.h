// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file lidar_look.h Properties of a LiDAR that its points show: lines, field of view, ranges. */
#pragma once

#include <fastlio/lidar/scan.h>

#include <array>
#include <cstddef>
#include <set>
#include <vector>

namespace fastlio
{
/** Gathered over some scans. */
class LidarLook
{
 public:
  void add(const PointColumns& points);

  [[nodiscard]] std::size_t scans() const { return scans_; }
  [[nodiscard]] double pointsPerScan() const;
  [[nodiscard]] int lines() const;        //!< distinct lines; 0: points have none, or too many
  [[nodiscard]] double lowest() const;    //!< elevation, 1 % of the points are below [deg]
  [[nodiscard]] double highest() const;   //!< elevation, 1 % of the points are above [deg]
  [[nodiscard]] double coverage() const;  //!< fraction of the azimuths with points, 0..1
  [[nodiscard]] double rangeQuantile(double fraction) const;  //!< [m]; fraction 0..1

 private:
  static constexpr std::size_t kSectors = 72;

  std::size_t scans_ = 0, points_ = 0;
  std::set<std::uint16_t> rings_;
  std::array<bool, kSectors> sectors_{};
  std::vector<float> ranges_, elevations_;  // of every so many-th point
};

}  // namespace fastlio
