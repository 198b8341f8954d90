// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file simulated_observations.h A simulation as a stream of MRPT observations. */
#pragma once

#include <fastlio/simulation/observations.h>
#include <fastlio/simulation/simulation.h>

#include <mrpt/obs/CObservation.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace fastlio::testing
{
/** IMU and scans in the order of time. */
inline std::vector<mrpt::obs::CObservation::Ptr> observationsOf(const Simulation& simulation)
{
  std::vector<mrpt::obs::CObservation::Ptr> list;
  for (const auto& sample : simulation.imu().samples)
    list.push_back(toImuObservation(sample));
  for (std::size_t i = 0; i < simulation.scanCount(); ++i)
    list.push_back(toLidarObservation(simulation, i));
  std::stable_sort(
      list.begin(), list.end(),
      [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
  return list;
}

}  // namespace fastlio::testing
