// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file xyzirt_access.h Point clouds as columns, in and out of MRPT's point maps, on every MRPT.
 */
#pragma once

#include <fastlio/compat/CPointsMapXYZIRT.h>
#include <fastlio/lidar/scan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace fastlio
{
/** The fields of a cloud as stored, nothing interpreted: x, y, z have equal lengths, each of the
 * others is either empty (the cloud lacks the field) or as long. */
struct CloudColumns
{
  std::vector<float> x, y, z;          //!< [m]
  std::vector<float> intensity;        //!< sensor's own scale
  std::vector<std::uint16_t> ring;     //!< laser line
  std::vector<double> time;            //!< in the recording's unit, see findPointTimes()
  bool single_precision_time = false;  //!< the field holds 32-bit numbers

  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/** Usual names of a field with the times of points, in messages, in files and in clouds of MRPT.
 * First those that can mean nothing else. */
inline constexpr std::array<std::string_view, 15> kPointTimeNames{
    "t",          "time",       "timestamp",   "time_stamp",    "timeStamp",
    "timeOffset", "timeoffset", "time_offset", "offset_time",   "offsetTime",
    "point_time", "time_ns",    "t_offset",    "relative_time", "stamp"};

/** Copies the fields of any MRPT point map: all of CPointsMapXYZIRT; of CGenericPointsMap those
 * with a usual name ("t", "time", "timestamp", "ring", "intensity", ...) and any type; intensity of
 * CPointsMapXYZI; coordinates of the others. */
[[nodiscard]] CloudColumns readColumns(const mrpt::maps::CPointsMap& cloud);

/** A map of the given fields; times as they are, in 32 bits.
 * \exception std::invalid_argument columns of unequal lengths (the message names the column) */
[[nodiscard]] mrpt::maps::CPointsMapXYZIRT::Ptr makeXyzirt(const CloudColumns& columns);

/** A map of all fields; times become seconds relative to the scan's stamp.
 * \exception std::invalid_argument columns of unequal lengths */
[[nodiscard]] mrpt::maps::CPointsMapXYZIRT::Ptr makeXyzirt(const PointColumns& points);

}  // namespace fastlio
