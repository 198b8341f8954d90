// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file range_unit.h Are the points of a LiDAR in metres? */
#pragma once

#include <fastlio/lidar/scan.h>

#include <cstddef>
#include <optional>

namespace fastlio
{
/** Decides with the first scan that has enough points, and brings all scans to metres. Drivers that
 * pass on raw integers give millimetres. */
class RangeUnit
{
 public:
  /** Scales the points of a scan, if its LiDAR gives millimetres.
   * \return the median range as delivered [as delivered], with the scan that showed the unit to be
   * millimetres */
  std::optional<double> bringToMetres(PointColumns& points);

 private:
  bool decided_ = false, millimetres_ = false;
};

}  // namespace fastlio
