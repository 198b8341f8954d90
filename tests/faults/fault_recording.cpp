// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "fault_recording.h"

#include <fastlio/compat/register_classes.h>
#include <fastlio/config/config_document.h>
#include <fastlio/scenarios/scenario.h>
#include <fastlio/simulation/observations.h>
#include <fastlio/simulation/recording.h>

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace fastlio::testing
{
namespace
{
SimulationSettings settingsOf(LidarKind kind)
{
  SimulationSettings settings = defaultSettings("office");
  if (kind == LidarKind::Os64) settings.lidar = defaultSettings("shake").lidar;
  settings.duration = 9.0;
  settings.rest = 2.5;
  settings.lidar.stride = kind == LidarKind::Vlp16 ? 2 : 16;
  return settings;
}

std::vector<std::int64_t> endsOfScans(const Simulation& simulation)
{
  std::vector<std::int64_t> ends;
  for (std::size_t i = 0; i < simulation.scanCount(); ++i)
    ends.push_back(spanOf(simulation.scan(i)).end_ns);
  return ends;
}
}  // namespace

FaultRecording makeFaultRecording(LidarKind kind)
{
  registerBridgeClasses();
  const SimulationSettings settings = settingsOf(kind);
  const Simulation simulation(settings);
  FaultRecording recording;
  recording.ground_truth = groundTruthText(simulation);
  recording.config = toYaml(matchingConfig(settings));
  const std::vector<std::int64_t> ends = endsOfScans(simulation);
  std::size_t scan = 0;
  for (const ImuSample& sample : simulation.imu().samples)
  {
    recording.observations.push_back(toImuObservation(sample));
    for (; scan < ends.size() && ends[scan] <= sample.stamp_ns; ++scan)
      recording.observations.push_back(toLidarObservation(simulation, scan));
  }
  return recording;
}

Observations copyOf(const Observations& observations)
{
  Observations copies;
  for (const auto& observation : observations)
  {
    copies.push_back(
        std::dynamic_pointer_cast<mrpt::obs::CObservation>(observation->duplicateGetSmartPtr()));
    // The points would be shared.
    auto* cloud = dynamic_cast<mrpt::obs::CObservationPointCloud*>(copies.back().get());
    if (cloud != nullptr)
      cloud->pointcloud = std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(
          cloud->pointcloud->duplicateGetSmartPtr());
  }
  return copies;
}

RawlogBytes serialized(const Observations& observations)
{
  RawlogBytes rawlog;
  for (const auto& observation : observations)
  {
    mrpt::io::CMemoryStream stream;
    mrpt::serialization::archiveFrom(stream).WriteObject(*observation);
    rawlog.begins.push_back(rawlog.bytes.size());
    rawlog.bytes.append(
        static_cast<const char*>(stream.getRawBufferData()),
        static_cast<std::size_t>(stream.getTotalBytesCount()));
  }
  return rawlog;
}

std::string gzipped(const std::string& bytes)
{
  const auto path = std::filesystem::temp_directory_path() /
                    ("fastlio-faults-" + std::to_string(getpid()) + ".gz");
  {
    mrpt::io::CFileGZOutputStream file(path.string());
    file.Write(bytes.data(), bytes.size());
  }
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  std::filesystem::remove(path);
  return text.str();
}

}  // namespace fastlio::testing
