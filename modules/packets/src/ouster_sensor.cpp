// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Follows Ouster's software user manual: lidar data packet format, coordinate frames, IMU data.

#include "packet_numbers.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/gravity.h>
#include <fastlio/packets/ouster_sensor.h>
#include <fastlio/recordings/sensor_imu.h>
#include <fastlio/sensors/conversions.h>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::size_t kLegacyColumnHead = 16, kLegacyColumnFoot = 4;
constexpr std::size_t kPacketHead = 32, kColumnHead = 12;

Vec3 vectorAt(const std::uint8_t* bytes)
{
  return {littleAt<float>(bytes), littleAt<float>(bytes + 4), littleAt<float>(bytes + 8)};
}
}  // namespace

OusterSensor::OusterSensor(OusterMetadata metadata, std::string label)
    : metadata_(std::move(metadata)), label_(std::move(label)), scan_(label_)
{
  scan_.setPose(toMrptPose(metadata_.T_sensor_lidar));
}

bool OusterSensor::isMine(const UdpPacket& packet) const
{
  return packet.size == metadata_.packetBytes() || metadata_.isImuSize(packet.size);
}

void OusterSensor::take(const UdpPacket& packet, ObservationQueue& out)
{
  if (metadata_.isImuSize(packet.size))
    takeImu(packet, out);
  else if (packet.size == metadata_.packetBytes())
    for (std::size_t i = 0; i < metadata_.columns_per_packet; ++i)
      takeColumn(columnAt(packet.data, i), out);
}

void OusterSensor::takeImu(const UdpPacket& packet, ObservationQueue& out) const
{
  constexpr std::size_t kGyroTime = 16, kOldAcceleration = 24, kOldRate = 36;
  constexpr std::size_t kStatus = 10, kAcceleration = 12, kRate = 24;
  if (metadata_.imu_samples == 0)
  {
    addSample(
        packet.data + kGyroTime, kRadPerDeg * vectorAt(packet.data + kOldRate),
        kStandardGravity * vectorAt(packet.data + kOldAcceleration), out);
    return;
  }
  for (std::size_t i = 0; i < metadata_.imu_samples; ++i)
  {
    const std::uint8_t* sample = packet.data + kOusterImuHead + i * kOusterSampleBytes;
    const bool valid = (littleAt<std::uint16_t>(sample + kStatus) & 1U) != 0;
    if (valid) addSample(sample, vectorAt(sample + kRate), vectorAt(sample + kAcceleration), out);
  }
}

void OusterSensor::addSample(
    const std::uint8_t* stamp, const Vec3& rate, const Vec3& acceleration,
    ObservationQueue& out) const
{
  const auto stamp_ns = static_cast<std::int64_t>(littleAt<std::uint64_t>(stamp));
  if (!isStamp(stamp_ns)) return;
  auto imu = makeImu(label_ + "_imu", stamp_ns, rate, acceleration);
  imu->setSensorPose(toMrptPose(metadata_.T_sensor_imu));
  out.push_back(imu);
}

OusterSensor::Column OusterSensor::columnAt(const std::uint8_t* packet, std::size_t index) const
{
  constexpr std::size_t kId = 8, kStatus = 10;
  constexpr std::uint32_t kLegacyValid = 0xFFFFFFFF;
  const std::size_t pixels = metadata_.pixels * metadata_.profile.bytes;
  Column column;
  const std::uint8_t* at = metadata_.isLegacy()
                               ? packet + index * (kLegacyColumnHead + pixels + kLegacyColumnFoot)
                               : packet + kPacketHead + index * (kColumnHead + pixels);
  column.stamp_ns = static_cast<std::int64_t>(littleAt<std::uint64_t>(at));
  column.id = littleAt<std::uint16_t>(at + kId);
  column.pixels = at + (metadata_.isLegacy() ? kLegacyColumnHead : kColumnHead);
  column.valid = metadata_.isLegacy()
                     ? littleAt<std::uint32_t>(column.pixels + pixels) == kLegacyValid
                     : (littleAt<std::uint16_t>(at + kStatus) & 1U) != 0;
  column.valid =
      column.valid && column.id < metadata_.columns_per_frame && isStamp(column.stamp_ns);
  return column;
}

void OusterSensor::takeColumn(const Column& column, ObservationQueue& out)
{
  if (!column.valid) return;
  scan_.beginBlock(column.stamp_ns, column.id < last_id_, out);
  last_id_ = column.id;
  const double encoder =
      2.0 * M_PI *
      (1.0 - static_cast<double>(column.id) / static_cast<double>(metadata_.columns_per_frame));
  const OusterProfile& profile = metadata_.profile;
  for (std::size_t i = 0; i < metadata_.pixels; ++i)
  {
    const std::uint8_t* pixel = column.pixels + i * profile.bytes;
    const auto range = [&](std::size_t at)
    { return (littleAt<std::uint32_t>(pixel + at) & profile.range_mask) << profile.range_shift; };
    const std::uint32_t first = range(0);
    add(first, pixel[profile.reflectivity], i, encoder);
    if (profile.second == 0) continue;
    const std::uint32_t second = range(profile.second);
    if (second != first) add(second, pixel[profile.second_reflectivity], i, encoder);
  }
}

// The beams leave from a circle around the axis, whose radius is part of the range.
void OusterSensor::add(
    std::uint32_t range_mm, std::uint8_t reflectivity, std::size_t pixel, double encoder)
{
  if (range_mm == 0) return;
  const Vec3& origin = metadata_.beam_origin;
  const double range = 1e-3 * range_mm - std::hypot(origin.x(), origin.z());
  const double altitude = metadata_.altitude[pixel];
  const double azimuth = encoder - metadata_.azimuth[pixel];
  scan_.add(
      {range * std::cos(azimuth) * std::cos(altitude) + origin.x() * std::cos(encoder),
       range * std::sin(azimuth) * std::cos(altitude) + origin.x() * std::sin(encoder),
       range * std::sin(altitude) + origin.z(), static_cast<float>(reflectivity),
       static_cast<std::uint16_t>(pixel)},
      0.0);
}

}  // namespace fastlio
