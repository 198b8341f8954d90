// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_cloud_conversion.h CObservationPointCloud to points with times. */
#pragma once

#include <fastlio/lidar/scan.h>
#include <fastlio/mrpt_bridge/xyzirt_access.h>

#include <cstddef>

namespace fastlio
{
/** What the time field of a cloud is worth. */
enum class PointTimes
{
  PerPoint,  //!< seconds relative to the observation's stamp
  Absent,    //!< the cloud has no such field
  Unusable   //!< some are more than kMaxTimeOffset away from the stamp: absolute, or another unit
};

/** Farthest that a point may lie from its scan's stamp [s]; offsets are stored as 32-bit
 * nanoseconds. */
constexpr double kMaxTimeOffset = 2.0;

/** The usable points of a cloud. */
struct CloudConversion
{
  PointColumns points;  //!< time offsets are zero unless times == PerPoint
  PointTimes times = PointTimes::Absent;
  std::size_t dropped_invalid = 0;  //!< not finite (also in time), or at the origin
};

/** Points at (0, 0, 0) are what drivers write for "no return"; they are dropped like NaN. The time
 * of point i is stamp + time_s[i], of either sign. */
[[nodiscard]] CloudConversion toTimedPoints(const CloudColumns& cloud);

}  // namespace fastlio
