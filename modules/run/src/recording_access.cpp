// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/run/recording_access.h>

#include <mrpt/rtti/CObject.h>

#include <stdexcept>

namespace fastlio
{
void forEachObservation(
    const RecordingAccess& recording,
    const std::function<bool(const mrpt::obs::CObservation::Ptr&)>& use)
{
  if (recording.files.empty())
    throw std::runtime_error(
        "there is no recording to take raw observations from: the exporters rawlog and simplemap "
        "need one (ExportTarget::recording)");
  RawlogSource source(recording.files);
  while (const auto observation = source.next())
    if (!use(observation)) return;
}

bool isSelectedScan(const RecordingAccess& recording, const mrpt::obs::CObservation& observation)
{
  const SensorSummary& lidar = recording.selection.lidar;
  return observation.sensorLabel == lidar.label &&
         observation.GetRuntimeClass()->className == lidar.class_name;
}

}  // namespace fastlio
