// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file recording.h A simulated recording as files. */
#pragma once

#include <fastlio/config/config.h>
#include <fastlio/simulation/simulation.h>

#include <cstddef>
#include <functional>
#include <string>

namespace fastlio
{
/** Called after each sweep: how many are done, of how many. */
using RecordingProgress = std::function<void(std::size_t done, std::size_t total)>;

/** The files of a recording. */
struct RecordingFiles
{
  std::string rawlog;        //!< recording.rawlog (gzip)
  std::string ground_truth;  //!< ground_truth.tum: true pose of the IMU at 200 Hz
  std::string config;        //!< config.yaml: the odometry's parameters that match
  std::string scenario;      //!< scenario.json: all settings and what is true
};

/** Writes all files into a directory, which is created when absent. Each file appears under its
 * name when it is complete, the scenario as the last. The same settings give the same bytes.
 * \param overwrite also files that are no earlier recording may be replaced
 * \exception std::runtime_error a file cannot be written, or would replace one that is not ours */
RecordingFiles writeRecording(
    const Simulation& simulation, const std::string& directory,
    const RecordingProgress& progress = {}, bool overwrite = false);

/** The checks of writeRecording() on the directory, without making anything: for before a
 * simulation is computed. \exception std::exception as writeRecording() */
void requireRecordingPlace(const std::string& directory, bool overwrite);

/** The odometry's parameters that match the simulated sensors: noise densities (a vibration counts
 * as white noise of the same power), prior of the accelerometer bias, ranges, mounting, time
 * offset, gravity. */
[[nodiscard]] Config matchingConfig(const SimulationSettings& settings);

/** The odometry's part of matchingConfig(). */
[[nodiscard]] OdometryOptions matchingParameters(const SimulationSettings& settings);

/** True pose of the IMU at 200 Hz as TUM text: `time x y z qx qy qz qw`. */
[[nodiscard]] std::string groundTruthText(const Simulation& simulation);

/** All settings and what is true, as JSON. */
[[nodiscard]] std::string scenarioJson(const Simulation& simulation);

}  // namespace fastlio
