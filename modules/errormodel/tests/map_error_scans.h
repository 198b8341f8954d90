// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_error_scans.h Scans for tests of the map's error: everything round, so that results are
 * known by heart. */
#pragma once

#include <fastlio/errormodel/map_error.h>

#include <cstdint>
#include <initializer_list>

namespace fastlio::testing
{
inline constexpr double kScanInformation = 1e4;

/** Half of the weight on planes of each insertion; planes without errors of their own. */
inline GroupedMeasurements scanOn(std::initializer_list<std::uint32_t> insertions)
{
  GroupedMeasurements scan;
  scan.information = kScanInformation * Matrix6::Identity();
  for (const std::uint32_t insertion : insertions)
  {
    PlaneGroup& group = scan.groups.emplace_back();
    group.weight = 1.0;
    group.created_insertion = insertion;
  }
  return scan;
}

/** An update that puts the scan wherever the map says: K H = I on the pose. */
inline LinearizedUpdate fullTrust()
{
  LinearizedUpdate update;
  update.gain.topRows<6>() = Matrix6::Identity() / kScanInformation;
  return update;
}

/** The filter knows the pose like this when planes are created. */
inline InsertionError poseError(const Matrix6& covariance)
{
  InsertionError error;
  error.filter.topLeftCorner<6, 6>() = covariance;
  return error;
}

inline InsertionError poseError(double variance)
{
  return poseError(Matrix6(variance * Matrix6::Identity()));
}

inline Matrix6 poseAddition(const MapErrorModel& model)
{
  return model.addition().topLeftCorner<6, 6>();
}

}  // namespace fastlio::testing
