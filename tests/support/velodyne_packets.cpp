// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "velodyne_packets.h"

#include "test_files.h"
#include <fastlio/sensors/conversions.h>

#include <cmath>
#include <cstring>

namespace
{
constexpr std::size_t kBlockBytes = 100, kReturnBytes = 3, kTimeOffset = 1200;
constexpr std::uint16_t kFullCircle = 36000;

char* bytesOf(fastlio::testing::Packet& packet)
{
  return reinterpret_cast<char*>(&packet);
}
}  // namespace

namespace fastlio::testing
{
static_assert(sizeof(Packet) == 1206);

Packet makePacket(
    std::uint16_t azimuth, std::uint16_t step, std::uint32_t time_us, std::uint16_t distance,
    std::uint8_t mode, std::uint8_t model, std::size_t group)
{
  Packet packet{};
  for (std::size_t block = 0; block < kBlocks; ++block)
  {
    setHeader(packet, block, 0xEEFF);
    const std::size_t turned = azimuth + step * (block / group);
    setAzimuth(packet, block, static_cast<std::uint16_t>(turned % kFullCircle));
    for (std::size_t i = 0; i < kReturns; ++i)
      setReturn(packet, block, i, distance);
  }
  std::memcpy(bytesOf(packet) + kTimeOffset, &time_us, sizeof time_us);
  packet.laser_return_mode = mode;
  packet.velodyne_model_ID = model;
  return packet;
}

void setHeader(Packet& packet, std::size_t block, std::uint16_t header)
{
  std::memcpy(bytesOf(packet) + block * kBlockBytes, &header, sizeof header);
}

void setAzimuth(Packet& packet, std::size_t block, std::uint16_t azimuth)
{
  std::memcpy(bytesOf(packet) + block * kBlockBytes + 2, &azimuth, sizeof azimuth);
}

void setReturn(
    Packet& packet, std::size_t block, std::size_t index, std::uint16_t distance,
    std::uint8_t intensity)
{
  char* at = bytesOf(packet) + block * kBlockBytes + 4 + index * kReturnBytes;
  std::memcpy(at, &distance, sizeof distance);
  std::memcpy(at + 2, &intensity, sizeof intensity);
}

mrpt::obs::CObservationVelodyneScan::Ptr makeVlp16Scan(const std::vector<Packet>& packets)
{
  auto scan = mrpt::obs::CObservationVelodyneScan::Create();
  scan->sensorLabel = "lidar";
  scan->timestamp = fastlio::toMrptTime(kStart);
  scan->calibration = mrpt::obs::VelodyneCalibration::LoadDefaultCalibration("VLP16");
  scan->scan_packets = packets;
  return scan;
}

double rangeOf(const fastlio::PointColumns& p, std::size_t i)
{
  return std::hypot(p.x[i], p.y[i], p.z[i]);
}

double elevationOf(const fastlio::PointColumns& p, std::size_t i)
{
  return std::atan2(p.z[i], std::hypot(p.x[i], p.y[i])) / kDegree;
}

double azimuthOf(const fastlio::PointColumns& p, std::size_t i)
{
  const double degrees = std::atan2(-p.y[i], p.x[i]) / kDegree;
  return degrees < 0 ? degrees + 360 : degrees;
}

}  // namespace fastlio::testing
