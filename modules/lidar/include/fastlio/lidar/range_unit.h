// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file range_unit.h Are the points of a LiDAR in metres? */
#pragma once

#include <fastlio/lidar/scan.h>

#include <optional>
#include <string>

namespace fastlio
{
/** Why the points of a LiDAR cannot be those of a sensor that delivers metres. */
enum class RangeDefect
{
  Millimetres,  //!< they are brought to metres
  FarAway,      //!< farther than LiDARs see: perhaps centimetres; left as they are
  OneDirection  //!< far away, and all in one direction: in the frame of a map; left as they are
};

struct RangeFinding
{
  RangeDefect defect;
  double median;  //!< of the ranges, as delivered
};

/** In a sentence, with what to do. */
[[nodiscard]] std::string describe(const RangeFinding& finding);

/** Decides with the first scan that has enough points, and brings all scans to metres. Drivers that
 * pass on raw integers give millimetres. */
class RangeUnit
{
 public:
  /** Scales the points of a scan, if its LiDAR gives millimetres.
   * \return with the scan that shows it, what is wrong with the points */
  std::optional<RangeFinding> bringToMetres(PointColumns& points);

 private:
  bool decided_ = false, millimetres_ = false;
};

}  // namespace fastlio
