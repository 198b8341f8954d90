// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rotating_scan.h CObservationRotatingScan of every MRPT: range images, with or without
 * their points.
 *
 * MRPT 2.11.4 changed the stream format of the class without a new version number: each side reads
 * its own files only. Here both are read. */
#pragma once

#include <fastlio/compat/mrpt_compat.h>
#include <fastlio/lidar/scan.h>

#include <mrpt/math/TPoint3D.h>
#include <mrpt/obs/CObservationRotatingScan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
#if FASTLIO_MRPT_HAS_ROTATING_POINTS
using RotatingScan = mrpt::obs::CObservationRotatingScan;
#else
/** Further members of newer versions of the class. */
class RotatingScan : public mrpt::obs::CObservationRotatingScan
{
 public:
  std::vector<mrpt::math::TPoint3Df> points;  //!< row by row, sensor frame [m]; empty: none
  std::string external_file;                  //!< where the images lie; empty: here
  std::uint8_t external_format = 0;           //!< 1: MRPT's serialisation, 2: text
};
#endif

/** The points of a scan: those that it holds, else from its range image when the model of the
 * sensor gives the elevation of the rows (VLP-16, HDL-32E, HDL-64E). */
struct RotatingScanPoints
{
  PointColumns points;           //!< times from the first column on
  bool has_point_times = false;  //!< those of the columns, see hasColumnTimes()
  std::size_t no_return = 0;     //!< pixels without a range
  std::size_t out_of_range = 0;  //!< outside of the observation's [minRange, maxRange]
};

/** The scan gives the duration of a sweep, and one that a LiDAR may have. */
[[nodiscard]] bool hasColumnTimes(const mrpt::obs::CObservationRotatingScan& scan);

/** \exception std::runtime_error there are no points, and no way to make them (says why) */
[[nodiscard]] RotatingScanPoints pointsOf(const mrpt::obs::CObservationRotatingScan& scan);

}  // namespace fastlio
