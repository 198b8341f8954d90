// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "fuzz_targets.h"

#include "memory_file.h"
#include <fastlio/compat/register_classes.h>
#include <fastlio/config/config_document.h>
#include <fastlio/config/config_yaml.h>
#include <fastlio/odometry/odometry.h>
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/observation_bridge.h>
#include <fastlio/sensors/point_cloud_conversion.h>
#include <fastlio/sensors/velodyne_decoder.h>
#include <fastlio/survey/sensor_selection.h>

#include <mrpt/containers/yaml.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace fastlio::testing
{
namespace
{
OdometryOptions smallParameters()
{
  OdometryOptions parameters;
  parameters.threads = 1;
  parameters.initialization.duration = 0.1;
  return parameters;
}

void feed(Odometry& odometry, const BridgeOutput& output)
{
  if (const auto* sample = std::get_if<ImuSample>(&output)) odometry.addImu(*sample);
  if (const auto* scan = std::get_if<LidarScan>(&output)) odometry.addScan(*scan);
  while (const auto result = odometry.next())
    if (!isFinite(result->filter.x)) throw std::logic_error("a state that is not finite");
}

/** The next number out of the bytes; zero when they have ended. */
template <typename T>
T take(const std::uint8_t*& data, std::size_t& size)
{
  T value{};
  const std::size_t n = std::min(size, sizeof(T));
  std::memcpy(&value, data, n);
  data += n;
  size -= n;
  return value;
}
}  // namespace

void fuzzRawlog(const std::uint8_t* data, std::size_t size)
{
  registerBridgeClasses();
  const MemoryFile file(data, size);
  SensorSelection selection;
  try
  {
    selection = selectSensors(surveySensors({file.path()}, {}), {});
  }
  catch (const std::runtime_error&)
  {
    // No usable sensors: convert those that are there all the same, under the usual labels.
    selection.lidar.label = "lidar";
    selection.lidar.class_name = "mrpt::obs::CObservationPointCloud";
    selection.imu.label = "imu";
    selection.imu.class_name = "mrpt::obs::CObservationIMU";
  }
  ObservationBridge bridge(selection);
  Odometry odometry(smallParameters());
  RawlogSource source({file.path()});
  while (const auto observation = source.next())
    feed(odometry, bridge.convert(*observation));
  while (const auto result = odometry.flush())
    if (!isFinite(result->filter.x)) throw std::logic_error("a state that is not finite");
}

void fuzzPackets(const std::uint8_t* data, std::size_t size)
{
  using mrpt::obs::CObservationVelodyneScan;
  CObservationVelodyneScan scan;
  scan.timestamp = mrpt::Clock::fromDouble(1.7e9);
  constexpr std::size_t kPacket = sizeof(CObservationVelodyneScan::TVelodyneRawPacket);
  for (std::size_t begin = 0; begin + kPacket <= size; begin += kPacket)
  {
    CObservationVelodyneScan::TVelodyneRawPacket packet{};
    std::memcpy(&packet, data + begin, kPacket);
    scan.scan_packets.push_back(packet);
  }
  try
  {
    const VelodyneSweep sweep = decodeVelodyne(scan);
    if (sweep.points.x.size() != sweep.points.time_offset_ns.size())
      throw std::logic_error("columns of different length");
  }
  catch (const std::runtime_error&)
  {
    // A model that is not supported.
  }
}

void fuzzCloud(const std::uint8_t* data, std::size_t size)
{
  CloudColumns columns;
  const auto fields = take<std::uint8_t>(data, size);
  while (size >= 4)
  {
    columns.x.push_back(take<float>(data, size));
    columns.y.push_back(take<float>(data, size));
    columns.z.push_back(take<float>(data, size));
    if ((fields & 1U) != 0) columns.intensity.push_back(take<float>(data, size));
    if ((fields & 2U) != 0) columns.ring.push_back(take<std::uint16_t>(data, size));
    if ((fields & 4U) != 0) columns.time.push_back(take<float>(data, size));
  }
  LidarScan scan;
  scan.stamp_ns = 1'700'000'000'000'000'000;
  scan.points = toTimedPoints(columns, scan.stamp_ns, {}).points;
  Odometry odometry(smallParameters());
  for (int i = 0; i <= 100; ++i)
    odometry.addImu({scan.stamp_ns + i * 5'000'000, Vec3::Zero(), Vec3(0, 0, 9.81)});
  for (int i = 0; i < 3; ++i, scan.stamp_ns += 100'000'000)
    odometry.addScan(scan);
  while (const auto result = odometry.flush())
    if (!isFinite(result->filter.x)) throw std::logic_error("a state that is not finite");
}

void fuzzYaml(const std::uint8_t* data, std::size_t size)
{
  if (size == 0) return;  // no file to read
  const MemoryFile file(data, size);
  try
  {
    const Config config = loadConfigFromFile(file.path());
    (void)toYaml(config);
  }
  catch (const std::invalid_argument&)
  {
    // Refused, with the reason.
  }
}

const std::vector<FuzzTarget>& fuzzTargets()
{
  static const std::vector<FuzzTarget> targets{
      {"rawlog", fuzzRawlog},
      {"packets", fuzzPackets},
      {"cloud", fuzzCloud},
      {"yaml", fuzzYaml},
      {"ply", fuzzMap},
      {"pcd", fuzzMap},
      {"archive", fuzzMap},
      {"trajectory", fuzzTrajectory},
      {"label", fuzzLabel},
      {"external", fuzzExternal},
      {"commandline", fuzzCommandLine},
      {"bag", fuzzRecording},
      {"mcap", fuzzRecording},
      {"database", fuzzRecording},
      {"message", fuzzMessage},
      {"capture", fuzzCapture},
      {"metadata", fuzzMetadata},
      {"cloudfile", fuzzCloudFile}};
  return targets;
}

}  // namespace fastlio::testing
