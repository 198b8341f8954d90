// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file recording_access.h The recording once more, for files that hold raw observations. */
#pragma once

#include <fastlio/sensors/observation_bridge.h>
#include <fastlio/survey/sensor_selection.h>

#include <mrpt/obs/CObservation.h>

#include <functional>
#include <string>
#include <vector>

namespace fastlio
{
/** The files that were read, and their options: exporters go through it a second time, so that raw
 * scans need not be kept in memory during the run. */
struct RecordingAccess
{
  std::vector<std::string> files;
  SensorSelection selection;
  BridgeOptions bridge;
};

/** Hands over every observation of the recording in order of time, until \a use returns false.
 * \exception std::runtime_error there is no recording to go through */
void forEachObservation(
    const RecordingAccess& recording,
    const std::function<bool(const mrpt::obs::CObservation::Ptr&)>& use);

/** Whether the observation is a scan of the selected LiDAR. */
[[nodiscard]] bool isSelectedScan(
    const RecordingAccess& recording, const mrpt::obs::CObservation& observation);

}  // namespace fastlio
