// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file file_points.h The points of a map file, in single precision wherever they lie. */
#pragma once

#include <fastlio/map/surface_map.h>
#include <fastlio/math/so3.h>

#include <array>

namespace fastlio
{
// Farther away is no place on the earth [m].
constexpr double kFarthestPoint = 1e7;

/** Points that are counted from a place near them when they lie far from the origin of their file:
 * at UTM coordinates, single precision has steps of half a metre. */
class FilePoints
{
 public:
  /** The first usable point decides on the origin. \param p in the coordinates of the file [m] */
  void add(const std::array<double, 3>& p);

  /** Finite, and at most kFarthestPoint from the origin of the file along each axis. */
  [[nodiscard]] static bool usable(const std::array<double, 3>& p);

  WorldPoints points;          //!< counted from the origin
  Vec3 origin = Vec3::Zero();  //!< in the coordinates of the file, whole kilometres [m]

 private:
  bool placed_ = false;
};

}  // namespace fastlio
