// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan.h A LiDAR scan with the time of every point. */
#pragma once

#include <fastlio/math/pose.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** Points as columns of equal length, LiDAR frame. */
struct PointColumns
{
  std::vector<float> x, y, z;                //!< [m]
  std::vector<float> intensity;              //!< sensor's own scale; 0 when it has none
  std::vector<std::int32_t> time_offset_ns;  //!< point time minus the scan's stamp_ns
  std::vector<std::uint16_t> ring;           //!< laser line; 0 when unknown

  [[nodiscard]] std::size_t size() const { return x.size(); }
  void clear();
  void reserve(std::size_t n);
  void resize(std::size_t n);
  /** Copies a point over another one. */
  void copy(std::size_t from, std::size_t to);
  void push_back(
      float px, float py, float pz, float point_intensity, std::int32_t offset_ns,
      std::uint16_t point_ring);
};

/** One sweep of a LiDAR. */
struct LidarScan
{
  std::int64_t stamp_ns = 0;  //!< reference time of the points' offsets, UNIX epoch [ns]
  PointColumns points;
  Pose T_imu_lidar;                 //!< extrinsic: LiDAR frame to IMU frame
  std::size_t dropped_invalid = 0;  //!< returns that the bridge left out: no echo, NaN, zero
  bool has_point_times = true;      //!< false: all points are taken at stamp_ns, no deskew
};

/** Time span of a scan's points [ns since the epoch]. */
struct ScanSpan
{
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;

  /** The latest instant that a run may start at to take in the scan. One without point times begins
   * and ends at its stamp. */
  [[nodiscard]] std::int64_t latestStart() const { return std::min(begin_ns, end_ns - 1); }
};

/** Earliest and latest point time; both stamp_ns when the scan is empty. */
[[nodiscard]] ScanSpan spanOf(const LidarScan& scan);

}  // namespace fastlio
