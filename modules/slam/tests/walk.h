// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file walk.h A short simulated walk as observations. */
#pragma once

#include <fastlio/simulation/observations.h>
#include <fastlio/simulation/recording.h>
#include <fastlio/simulation/simulation.h>

#include <mrpt/obs/CObservation.h>

#include <algorithm>
#include <vector>

namespace fastlio::testing
{
/** Ten seconds in the office, two of them at rest. */
inline const Simulation& walk()
{
  static const Simulation simulation = []
  {
    SimulationSettings settings = defaultSettings("office");
    settings.duration = 10.0;
    return Simulation(settings);
  }();
  return simulation;
}

/** IMU and scans of the walk in the order of time. */
inline const std::vector<mrpt::obs::CObservation::Ptr>& observations()
{
  static const auto all = []
  {
    std::vector<mrpt::obs::CObservation::Ptr> list;
    for (const auto& sample : walk().imu().samples)
      list.push_back(toImuObservation(sample));
    for (std::size_t i = 0; i < walk().scanCount(); ++i)
      list.push_back(toLidarObservation(walk(), i));
    std::stable_sort(
        list.begin(), list.end(),
        [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
    return list;
  }();
  return all;
}

}  // namespace fastlio::testing
