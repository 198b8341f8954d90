// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file cloud_formats.h Point clouds as different drivers write them (internal). */
#pragma once

#include <fastlio/lidar/scan.h>
#include <fastlio/scenarios/settings.h>

#include <mrpt/maps/CPointsMap.h>

#include <cstdint>

namespace fastlio
{
/** Class, unit and zero of the times. */
class CloudFormat
{
 public:
  explicit CloudFormat(const LidarSettings& lidar);

  /** From the first shot to the instant that the scan's stamp is about [ns]. */
  [[nodiscard]] std::int64_t stampShift() const { return shift_ns_; }

  /** \param points with times from the first shot \param first_shot_ns its stamp */
  [[nodiscard]] mrpt::maps::CPointsMap::Ptr encode(
      const PointColumns& points, std::int64_t first_shot_ns) const;

 private:
  [[nodiscard]] double timeOf(std::int32_t offset_ns, std::int64_t first_shot_ns) const;

  LidarCloud cloud_;
  bool absolute_;
  double unit_ns_;  // nanoseconds per unit
  std::int64_t shift_ns_;
};

}  // namespace fastlio
