// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file control_points.h Files of places that are known in the map and on the earth. */
#pragma once

#include <fastlio/earth/earth_fit.h>
#include <fastlio/earth/local_frame.h>
#include <fastlio/earth/reference_system.h>

#include <cstddef>
#include <string>
#include <vector>

namespace fastlio
{
/** A row of a file of control points. */
struct ControlPoint
{
  std::string name;
  Vec3 map = Vec3::Zero();  //!< in the frame of the map [m]
  GeodeticPoint place;
  double std_m = 0.05;  //!< of each coordinate, where the row has none
};

/** More are no control points. */
inline constexpr std::size_t kMostControlPoints = 100'000;

/** Reads a table of comma-separated values. Its first row names the columns, in any order:
 * `name,map_x,map_y,map_z`, and either `latitude,longitude` [deg] or `east,north` [m], and `height`
 * [m]; `std` [m] may be there. Empty lines and those that begin with # are passed over.
 * \param system of easting, northing and height; latitudes do without one, and the heights beside
 * them are above the WGS84 ellipsoid
 * \exception std::runtime_error the file cannot be read, or a row is wrong; the message names file,
 * line, column and value */
[[nodiscard]] std::vector<ControlPoint> readControlPoints(
    const std::string& path, const ReferenceSystem* system = nullptr);

/** For fitToEarth(). */
[[nodiscard]] std::vector<Correspondence> correspondencesIn(
    const LocalFrame& frame, const std::vector<ControlPoint>& points);

}  // namespace fastlio
