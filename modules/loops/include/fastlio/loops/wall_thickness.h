// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file wall_thickness.h How thick walls are that two passes saw: double walls are thick ones. */
#pragma once

#include <fastlio/loops/mapper.h>

#include <cstddef>
#include <optional>

namespace fastlio
{
/** Thickness of the walls that both submaps of an accepted closure saw: rms distance of the points
 * from a plane. Each number is the median over the walls, so that a few wrong pairs do not
 * determine it. */
struct WallThickness
{
  std::size_t walls = 0;  //!< pieces of walls, up to 1.6 m wide, once for each closure
  double single = 0.0;    //!< each pass with a plane of its own [m]
  double after = 0.0;     //!< both passes with one plane, corrected; each counts half [m]
  /** Likewise with the poses of the odometry [m], where both passes are of the same session:
   * sessions have no common frame before. */
  std::optional<double> before;

  /** How much thicker two passes are than one. */
  [[nodiscard]] double ratio() const { return single > 0.0 ? after / single : 0.0; }
};

/** Nothing where no wall was seen twice. */
[[nodiscard]] std::optional<WallThickness> wallThickness(const MappingResult& result);

}  // namespace fastlio
