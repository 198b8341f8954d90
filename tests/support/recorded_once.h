// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file recorded_once.h A recording that several tests read is simulated once. */
#pragma once

#include "temporary_folder.h"
#include <fastlio/simulation/recording.h>

#include <filesystem>
#include <map>
#include <string>

namespace fastlio::testing
{
/** writeRecording(), but all calls of a process with the same settings share one simulation. Each
 * gets files of its own: a test may damage them. \return the path of the rawlog */
inline std::string recordedOnce(const SimulationSettings& settings, const std::string& directory)
{
  static const TemporaryFolder kept;
  static std::map<std::string, std::string> folders;  // by all settings
  const Simulation simulation(settings);
  const auto [made, is_new] =
      folders.try_emplace(scenarioJson(simulation), kept.file(std::to_string(folders.size())));
  if (is_new) writeRecording(simulation, made->second);
  std::filesystem::copy(made->second, directory, std::filesystem::copy_options::recursive);
  return directory + "/recording.rawlog";
}
}  // namespace fastlio::testing
