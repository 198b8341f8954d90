// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_cloud_conversion.h Point clouds to points with times. */
#pragma once

#include <fastlio/lidar/point_time.h>
#include <fastlio/lidar/scan.h>
#include <fastlio/lidar/sweep_time.h>
#include <fastlio/sensors/xyzirt_access.h>

#include <cstddef>
#include <optional>

namespace fastlio
{
/** Where the times of a cloud's points come from. */
enum class PointTimes
{
  PerPoint,   //!< the cloud's own
  Synthetic,  //!< from the azimuth
  Absent,     //!< there are none, or they are not to be used: all points at the stamp
  Unusable    //!< many are more than kMaxTimeOffset away from the stamp: all points at the stamp
};

/** How the points of a LiDAR's clouds get their times. */
struct CloudTiming
{
  std::optional<PointTimeReading> reading = PointTimeReading{};  //!< of the time field, if any
  std::optional<SweepTiming> sweep;  //!< for clouds whose time field is absent or not to be read
};

/** The usable points of a cloud. */
struct CloudConversion
{
  PointColumns points;  //!< time offsets are zero unless times is PerPoint or Synthetic
  PointTimes times = PointTimes::Absent;
  std::size_t dropped_invalid = 0;  //!< not finite, at the origin, or of an impossible time
};

/** Points at (0, 0, 0) are what drivers write for "no return"; they are dropped like NaN. */
[[nodiscard]] CloudConversion toTimedPoints(
    CloudColumns cloud, std::int64_t stamp_ns, const CloudTiming& timing = {});

}  // namespace fastlio
