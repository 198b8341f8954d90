// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file simulated_submaps.h The submaps of a simulated recording. */
#pragma once

#include <fastlio/odometry/odometry.h>
#include <fastlio/simulation/recording.h>
#include <fastlio/simulation/simulation.h>
#include <fastlio/submaps/submap.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace fastlio::testing
{
/** By the odometry with the parameters that match the simulated sensors, on one thread. */
inline std::vector<Submap> submapsOf(const Simulation& simulation, const SubmapRule& rule = {})
{
  OdometryOptions options = matchingParameters(simulation.settings());
  options.threads = 1;
  Odometry odometry(options);
  SubmapBuilder builder(0, rule);
  std::vector<Submap> submaps;
  odometry.setSampleCallback([&builder](const ImuSample& sample) { builder.addImu(sample); });
  for (const ImuSample& sample : simulation.imu().samples)
    odometry.addImu(sample);
  for (std::size_t i = 0; i < simulation.scanCount(); ++i)
  {
    odometry.addScan(simulation.scan(i));
    while (const auto result = odometry.next())
      if (auto submap = builder.add(*result, odometry.registeredPoints(), odometry.mapOrigin()))
        submaps.push_back(std::move(*submap));
  }
  if (auto submap = builder.finish()) submaps.push_back(std::move(*submap));
  return submaps;
}

}  // namespace fastlio::testing
