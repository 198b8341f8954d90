// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file walk.h A short simulated walk as observations. */
#pragma once

#include "simulated_observations.h"
#include <fastlio/simulation/recording.h>

#include <mrpt/obs/CObservation.h>

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
  static const auto all = observationsOf(walk());
  return all;
}

}  // namespace fastlio::testing
