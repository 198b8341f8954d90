// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "fuzz_targets.h"
#include "test_files.h"
#include <fastlio/compat/CPointsMapXYZIRT.h>
#include <fastlio/compat/register_classes.h>
#include <fastlio/config/config_document.h>

#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstring>

namespace fastlio::testing
{
namespace
{
using mrpt::obs::CObservationVelodyneScan;

constexpr double kSeedSeconds = 1.7e9;

template <typename T>
std::string bytesOf(const T& value)
{
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

mrpt::obs::CObservationIMU sampleAt(double t)
{
  mrpt::obs::CObservationIMU imu;
  imu.sensorLabel = "imu";
  imu.timestamp = mrpt::Clock::fromDouble(kSeedSeconds + t);
  for (const auto channel :
       {mrpt::obs::IMU_X_ACC, mrpt::obs::IMU_Y_ACC, mrpt::obs::IMU_WX, mrpt::obs::IMU_WY,
        mrpt::obs::IMU_WZ})
    imu.set(channel, 0.0);
  imu.set(mrpt::obs::IMU_Z_ACC, 9.81);
  return imu;
}

using Packet = CObservationVelodyneScan::TVelodyneRawPacket;
constexpr std::size_t kBlockBytes = 100, kReturnBytes = 3, kReturnMode = 1204, kModel = 1205;

/** A packet of twelve blocks with equal ranges, byte by byte as the sensor sends it.
 * \param second_header of every second block */
Packet packet(unsigned char second_header, unsigned char mode, unsigned char model)
{
  std::string bytes(sizeof(Packet), '\0');
  for (std::size_t block = 0; block < CObservationVelodyneScan::BLOCKS_PER_PACKET; ++block)
  {
    char* at = &bytes[block * kBlockBytes];
    at[0] = static_cast<char>(0xFF);
    at[1] = static_cast<char>(block % 2 == 1 ? second_header : 0xEE);
    const auto azimuth = static_cast<std::uint16_t>(40 * block);
    std::memcpy(at + 2, &azimuth, sizeof(azimuth));
    for (std::size_t i = 0; i < CObservationVelodyneScan::SCANS_PER_BLOCK; ++i)
      at[4 + kReturnBytes * i + 1] = 8;  // 4 m
  }
  bytes[kReturnMode] = static_cast<char>(mode);
  bytes[kModel] = static_cast<char>(model);
  Packet p{};
  std::memcpy(&p, bytes.data(), sizeof(p));
  return p;
}

Packet vlp16()
{
  return packet(0xEE, 0x37, 0x22);
}

CObservationVelodyneScan velodyneAt(double t)
{
  CObservationVelodyneScan scan;
  scan.sensorLabel = "lidar";
  scan.timestamp = scan.originalReceivedTimestamp = mrpt::Clock::fromDouble(kSeedSeconds + t);
  scan.scan_packets.push_back(vlp16());
  return scan;
}

template <typename Map>
mrpt::obs::CObservationPointCloud cloudAt(double t)
{
  mrpt::obs::CObservationPointCloud cloud;
  cloud.sensorLabel = "lidar";
  cloud.timestamp = mrpt::Clock::fromDouble(kSeedSeconds + t);
  const auto points = Map::Create();
  points->resize(12);
  for (std::size_t i = 0; i < points->size(); ++i)
    points->setPointFast(i, static_cast<float>(i), 2.0F, 0.1F * static_cast<float>(i));
  cloud.pointcloud = points;
  return cloud;
}

std::vector<Seed> rawlogSeeds()
{
  registerBridgeClasses();
  std::string imu, clouds;
  for (int i = 0; i < 40; ++i)
    imu += serialize(sampleAt(0.01 * i));
  for (int i = 0; i < 3; ++i)
    clouds += serialize(cloudAt<mrpt::maps::CPointsMapXYZIRT>(0.1 + 0.1 * i));
  mrpt::obs::CSensoryFrame frame;
  frame.insert(std::make_shared<mrpt::obs::CObservationIMU>(sampleAt(0.0)));
  frame.insert(std::make_shared<CObservationVelodyneScan>(velodyneAt(0.0)));
  return {
      {"imu_xyzirt", imu + clouds},
      {"velodyne", serialize(sampleAt(0.0)) + serialize(velodyneAt(0.0))},
      {"xyzi", serialize(sampleAt(0.0)) + serialize(cloudAt<mrpt::maps::CPointsMapXYZI>(0.0))},
      {"simple", serialize(sampleAt(0.0)) + serialize(cloudAt<mrpt::maps::CSimplePointsMap>(0.0))},
      {"frame", serialize(frame)}};
}

std::vector<Seed> packetSeeds()
{
  return {
      {"vlp16", bytesOf(vlp16()) + bytesOf(vlp16())},
      {"dual", bytesOf(packet(0xEE, 0x39, 0x22))},
      {"hdl32", bytesOf(packet(0xDD, 0x37, 0x21))}};
}

std::vector<Seed> cloudSeeds()
{
  std::string wall, timed(1, '\7');
  wall.push_back('\0');
  for (int i = 0; i < 40; ++i)
  {
    const auto f = static_cast<float>(i);
    for (const float value : {3.0F, 0.2F * f - 4.0F, 0.05F * f})
    {
      wall += bytesOf(value);
      timed += bytesOf(value);
    }
    timed += bytesOf(f) + bytesOf(static_cast<std::uint16_t>(i)) + bytesOf(0.002F * f);
  }
  return {{"wall", wall}, {"timed", timed}};
}

std::vector<Seed> yamlSeeds()
{
  return {
      {"defaults.yaml", configDump(
                            {}, [](std::string_view) { return "default"; }, false)},
      {"short.yaml", "imu: {max_gap: 0.2, accel_unit: g}\nthreads: 2\n"},
      {"poses.yaml", "input:\n  T_vehicle_imu: [0, 0, 1, 90, 0, 0]\n  lidar_sensor_label: 'l.*'\n"},
      {"wrong.yaml", "lidar: {min_range: [1, 2], max_range: -1}\nunknown: {a: &x 1, b: *x}\n"}};
}
}  // namespace

std::vector<Seed> seedsOf(const std::string& target)
{
  if (target == "rawlog") return rawlogSeeds();
  if (target == "packets") return packetSeeds();
  if (target == "cloud") return cloudSeeds();
  if (target == "yaml") return yamlSeeds();
  if (auto seeds = seedsOfRecordings(target); !seeds.empty()) return seeds;
  return seedsOfFiles(target);
}

}  // namespace fastlio::testing
