// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "cloud_formats.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/recordings/sensor_imu.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/velodyne_decoder.h>
#include <fastlio/simulation/lidar_errors.h>
#include <fastlio/simulation/observations.h>
#include <fastlio/simulation/vlp16.h>

#include <mrpt/obs/CObservationPointCloud.h>

#include <cmath>
#include <cstring>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservationIMU;
using mrpt::obs::CObservationPointCloud;
using mrpt::obs::CObservationVelodyneScan;
using RawPacket = CObservationVelodyneScan::TVelodyneRawPacket;

constexpr std::int64_t kHourUs = 3'600'000'000;
constexpr std::uint8_t kVlp16Id = 0x22;
constexpr double kMaxRawRange = 65535.0;

/** Little-endian bytes of a data packet, in order. */
class PacketBytes
{
 public:
  template <typename T>
  void append(T value)
  {
    for (std::size_t i = 0; i < sizeof(T); ++i)
      bytes_[used_++] = static_cast<std::uint8_t>((value >> (8U * i)) & 0xFFU);
  }

  [[nodiscard]] RawPacket packet() const
  {
    static_assert(sizeof(RawPacket) == CObservationVelodyneScan::PACKET_SIZE);
    RawPacket packet;
    std::memcpy(&packet, bytes_.data(), bytes_.size());
    return packet;
  }

 private:
  std::array<std::uint8_t, CObservationVelodyneScan::PACKET_SIZE> bytes_{};
  std::size_t used_ = 0;
};

std::uint16_t rawAzimuth(const Shot& first_of_block)
{
  // The first laser of a block points along the encoder's angle, clockwise from x.
  const double angle =
      std::atan2(-first_of_block.direction.y(), first_of_block.direction.x()) / kTwoPi;
  const auto hundredths = std::llround((angle - std::floor(angle)) * 36000.0);
  return static_cast<std::uint16_t>(hundredths % 36000);
}

std::uint16_t rawRange(double range)
{
  const double units = std::round(range / vlp16::kRangeUnit);
  return units > kMaxRawRange ? std::uint16_t{0} : static_cast<std::uint16_t>(units);
}

/** The packet made of the sweep's shots from number first on. */
RawPacket encodePacket(const FiredSweep& fired, std::size_t first, std::int64_t stamp_ns)
{
  constexpr std::size_t kShotsPerBlock = vlp16::kLasers * vlp16::kFiringsPerBlock;
  PacketBytes bytes;
  for (std::size_t i = first; i < first + vlp16::kShotsPerPacket; ++i)
  {
    if ((i - first) % kShotsPerBlock == 0)
    {
      bytes.append(CObservationVelodyneScan::UPPER_BANK);
      bytes.append(rawAzimuth(fired.sweep.shots[i]));
    }
    bytes.append(rawRange(fired.echoes[i].range));
    bytes.append(static_cast<std::uint8_t>(std::lround(fired.echoes[i].intensity)));
  }
  const std::int64_t stamp_us = (stamp_ns + fired.sweep.shots[first].offset_ns + 500) / 1000;
  bytes.append(static_cast<std::uint32_t>(stamp_us % kHourUs));
  bytes.append(CObservationVelodyneScan::RETMODE_STRONGEST);
  bytes.append(kVlp16Id);
  return bytes.packet();
}

/** The number of the first shot of each packet that arrives. */
std::vector<std::size_t> arrivedPackets(const FiredSweep& fired)
{
  std::vector<std::size_t> first_shots;
  for (std::size_t i = 0; i * vlp16::kShotsPerPacket < fired.sweep.shots.size(); ++i)
    if (fired.packet_lost.empty() || !fired.packet_lost[i])
      first_shots.push_back(i * vlp16::kShotsPerPacket);
  return first_shots;
}

CObservationPointCloud::Ptr toPointCloud(
    const FiredSweep& fired, const SimulationSettings& settings)
{
  auto observation = CObservationPointCloud::Create();
  observation->sensorLabel = kLidarLabel;
  observation->timestamp =
      toMrptTime(stampOfLidar(fired.sweep.stamp_ns, settings) + stampShiftOf(settings.lidar));
  observation->sensorPose = toMrptPose(settings.lidar.T_imu_lidar);
  observation->pointcloud =
      encodeCloud(pointsOf(fired), stampOfLidar(fired.sweep.stamp_ns, settings), settings.lidar);
  return observation;
}
}  // namespace

CObservationIMU::Ptr toImuObservation(const ImuSample& sample)
{
  return makeImu(kImuLabel, sample.stamp_ns, sample.gyro, sample.accel);
}

mrpt::obs::CObservationOdometry::Ptr toWheelObservation(const WheelReading& reading)
{
  auto observation = mrpt::obs::CObservationOdometry::Create();
  observation->sensorLabel = kWheelsLabel;
  observation->timestamp = toMrptTime(reading.stamp_ns);
  observation->odometry =
      mrpt::poses::CPose2D(reading.x, reading.y, std::remainder(reading.heading, kTwoPi));
  observation->hasVelocities = true;
  observation->velocityLocal = {reading.speed, 0.0, reading.turn_rate};
  return observation;
}

CObservationVelodyneScan::Ptr toVelodyneScan(
    const FiredSweep& fired, const SimulationSettings& settings)
{
  auto observation = CObservationVelodyneScan::Create();
  const std::int64_t stamp_ns = stampOfLidar(fired.sweep.stamp_ns, settings);
  const auto packets = arrivedPackets(fired);
  observation->sensorLabel = kLidarLabel;
  // Drivers take the time of the first packet that arrives.
  const std::int64_t waited_ns = packets.empty() ? 0 : fired.sweep.shots[packets.front()].offset_ns;
  observation->timestamp = toMrptTime(stamp_ns + waited_ns);
  observation->originalReceivedTimestamp = observation->timestamp;
  observation->has_satellite_timestamp = true;
  observation->sensorPose = toMrptPose(settings.lidar.T_imu_lidar);
  observation->minRange = settings.lidar.min_range;
  // Noise may carry a return beyond the range of surfaces.
  observation->maxRange = settings.lidar.max_range + 10.0 * settings.lidar.range_noise;
  observation->calibration = defaultVelodyneCalibration("VLP16");
  for (const std::size_t first : packets)
    observation->scan_packets.push_back(encodePacket(fired, first, stamp_ns));
  return observation;
}

mrpt::obs::CObservation::Ptr toLidarObservation(const Simulation& simulation, std::size_t index)
{
  const FiredSweep fired = simulation.fire(index);
  const LidarSettings& lidar = simulation.settings().lidar;
  if (lidar.kind == LidarKind::Vlp16 && lidar.cloud == LidarCloud::Native)
    return toVelodyneScan(fired, simulation.settings());
  return toPointCloud(fired, simulation.settings());
}

}  // namespace fastlio
