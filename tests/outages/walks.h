// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file walks.h Simulated walks, and whether the odometry was wrong and sure of it. */
#pragma once

#include "simulated_run.h"
#include <fastlio/math/time.h>
#include <fastlio/run/run_health.h>
#include <fastlio/scenarios/scenario.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio::testing
{
inline SimulationSettings walk(const std::string& scenario)
{
  SimulationSettings settings = defaultSettings(scenario);
  settings.duration = 24.0;
  return settings;
}

/** A walk, cast once for all its faults. */
struct CastWalk
{
  explicit CastWalk(const SimulationSettings& settings) : simulation(settings)
  {
    for (std::size_t i = 0; i < simulation.scanCount(); ++i)
      scans.push_back(simulation.scan(i));
  }

  /** With the options that match it, and one thread: tests run side by side. */
  [[nodiscard]] SimulatedRun runWith(AlteredInputs inputs) const
  {
    OdometryOptions options = matchingParameters(simulation.settings());
    options.threads = 1;
    inputs.cast = &scans;
    return runOdometryWith(inputs, simulation, options);
  }
  /** Of a stamp, since the walk's begin [s]. */
  [[nodiscard]] double secondsAt(std::int64_t stamp_ns) const
  {
    return toSeconds(stamp_ns - simulation.settings().start_ns);
  }

  Simulation simulation;
  std::vector<LidarScan> scans;
};

/** walk(scenario), cast once for all tests of a process: casting takes half of their time. */
inline const CastWalk& castWalk(std::string_view scenario)
{
  static std::map<std::string, CastWalk, std::less<>> walks;
  const auto known = walks.find(scenario);
  if (known != walks.end()) return known->second;
  const std::string name(scenario);
  return walks.try_emplace(name, walk(name)).first->second;
}

inline double positionError(const SimulatedRun& run, const JudgedScan& scan)
{
  return stateError(run, scan).segment<3>(kPosition).norm();
}

inline double positionStd(const JudgedScan& scan)
{
  return std::sqrt(scan.result.filter.P.diagonal().segment<3>(kPosition).sum());
}

/** \return the number of scans that claim to track and are off by more than 0.3 m and 5 sigma */
inline int confidentlyWrong(const SimulatedRun& run)
{
  int wrong = 0;
  for (const JudgedScan& scan : run.scans)
  {
    if (scan.result.status != ScanStatus::Tracking) continue;
    const double error = positionError(run, scan);
    if (error > 0.3 && error > 5.0 * positionStd(scan)) ++wrong;
  }
  return wrong;
}

/** As fastlio-replay names it: no scan is lost at the end, no stretch cannot be trusted. */
inline bool endsOk(const SimulatedRun& run)
{
  RunHealth health;
  for (const JudgedScan& scan : run.scans)
    health.add(scan.result);
  return countOf(run, ScanStatus::Diverged) == 0 && health.untrusted().empty();
}

}  // namespace fastlio::testing
