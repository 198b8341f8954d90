// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_thickness.h How sharp a map is. */
#pragma once

#include <fastlio/math/so3.h>

#include <string>
#include <vector>

namespace fastlio
{
/** A point of a map and when it was seen. */
struct TimedPoint
{
  Vec3 position = Vec3::Zero();  //!< [m]
  double time = 0.0;             //!< [s]
};

struct MapSharpness
{
  double thickness = 0.0;  //!< RMS distance of points to the surface of their cell [m]
  double revisit = 0.0;    //!< the same of cells seen again after a while; 0: there are none [m]
  double entropy = 0.0;    //!< mean of log det of the covariance of a point's cell
  double cells = 0.0;      //!< small cells that hold a point
  double surfaces = 0.0;   //!< cells with a surface
};

/** Fits a plane to the points of each cell. */
[[nodiscard]] MapSharpness mapSharpness(
    const std::vector<TimedPoint>& points, double cell = 0.8);

/** The map.ply of a run. \exception std::runtime_error it cannot be read */
[[nodiscard]] std::vector<TimedPoint> readRunMap(const std::string& path);

}  // namespace fastlio
