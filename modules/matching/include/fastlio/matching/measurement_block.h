// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file measurement_block.h Measurements of points side by side, as vector instructions take them. */
#pragma once

#include <fastlio/filter/update.h>

#include <cstddef>
#include <cstdint>

namespace fastlio
{
/** As many double-precision numbers as the widest registers of the processor family hold. */
inline constexpr std::size_t kLanes = 8;

/** The measurement of one point. */
struct PointMeasurement
{
  Vector6 weighted_h = Vector6::Zero();  //!< w h, the row by the scan pose
  double weight = 0.0;                   //!< w = 1 / variance
  double z = 0.0;                        //!< residual [m]
};

/** The measurements of eight points side by side, one per lane. Where the weight is 0 the lane does
 * not count, and its row and residual are 0, too. */
struct MeasurementBlock
{
  std::uint32_t index[kLanes] = {};  //!< of the points in the scan
  double weight[kLanes] = {};        //!< w = 1 / variance [1/m^2]
  double z[kLanes] = {};             //!< residuals [m]
  double h[6][kLanes] = {};          //!< rows by the scan pose

  [[nodiscard]] PointMeasurement point(std::size_t lane) const
  {
    PointMeasurement m;
    for (std::size_t k = 0; k < 6; ++k)
      m.weighted_h[static_cast<Eigen::Index>(k)] = weight[lane] * h[k][lane];
    m.weight = weight[lane];
    m.z = z[lane];
    return m;
  }
};

}  // namespace fastlio
