// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file weighted_yaw_fit.h Four degrees of freedom in closed form. */
#pragma once

#include <fastlio/earth/earth_fit.h>

#include <vector>

namespace fastlio
{
/** The turn about the vertical and the translation with the least sum of squared residuals.
 * \param information of each point [1/m^2]; not all are 0 */
[[nodiscard]] Pose weightedYawFit(
    const std::vector<Correspondence>& points, const std::vector<double>& information);

/** How well the points show the four. */
struct YawObservability
{
  double yaw_std_rad = 0;          //!< infinite where all points lie in one place
  double horizontal_spread_m = 0;  //!< rms distance from their centre, in the plane
};

[[nodiscard]] YawObservability yawObservability(
    const std::vector<Correspondence>& points, const std::vector<double>& information);

}  // namespace fastlio
